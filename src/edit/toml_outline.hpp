#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// Bytes of a text, the last one excluded.
struct TextRange {
  size_t begin = 0;
  size_t end = 0;

  std::string_view of(std::string_view text) const { return text.substr(begin, end - begin); }
};

// A [header] or [[header]] with the statements under it.
struct TomlSection {
  size_t begin = 0;  // of the header's line
  size_t end = 0;    // of the last statement's line, or the header's if there is none; the line break included
  std::optional<TextRange> lastStatement;  // its lines
  size_t keyWidth = 0;                     // bytes from the last key to its =
  bool linedUp = false;                    // keys are padded so that their = stand below each other
};

// Where the text of a TOML file has each value. A table may be written under a header, with dotted keys or in braces.
struct TomlNode {
  enum class Kind { table, array, scalar };

  Kind kind = Kind::table;
  std::string key;                                  // unquoted; empty for the root and for elements
  std::vector<std::unique_ptr<TomlNode>> children;  // of a table, elements of an array, in the order of the text
  std::optional<TextRange> value;                   // after the =, or as an element of brackets
  std::optional<TextRange> keyed;                   // from the key to the end of the value, if it has a key of its own
  std::optional<TextRange> statement;               // the whole lines of `keyed`, unless it stands in braces
  std::optional<TomlSection> section;               // of a table with a header, and of the root
  std::optional<TextRange> dotted;  // lines of the last statement that added to the table with a dotted key
  std::string dottedPrefix;         // before the key that such a statement adds: "sky."

  TomlNode* child(std::string_view name);
  const TomlNode* child(std::string_view name) const;
  bool inBraces() const { return kind == Kind::table && value.has_value(); }
};

// Items of braces or brackets, which commas separate: the values within, past tables that dotted keys make.
std::vector<TomlNode*> itemsOf(const TomlNode& list);

// `text` must be TOML 1.0 that has been parsed without an error.
TomlNode outlineOf(std::string_view text);

// The outline of a value that stands alone, such as "[1, 2]".
TomlNode outlineOfValue(std::string_view text);

}  // namespace speculum
