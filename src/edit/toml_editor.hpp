#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "edit/toml_layout.hpp"

namespace speculum {

// A key of a scene file's table with its value as TOML. Equal texts stand for equal values and the other way round.
struct KeyText {
  std::string table;  // "orbit" of orbit.speed; empty for a key of the table itself
  std::string key;
  std::string text;
  bool omissible = false;  // the value is the loader's default

  bool operator==(const KeyText&) const = default;
};

// Changes values in the text of a TOML file and keeps everything else: comments, order, blanks, line breaks. Nodes that
// functions take must be nodes of root(), which say where the text has them. text() applies the changes collected so
// far.
class TomlEditor {
 public:
  // `text` must have been parsed without an error.
  explicit TomlEditor(std::string text) : toml_(std::move(text)) {}

  const toml::table& root() const { return toml_.root(); }
  // Returns an element of the file's array `list`, which is an array of tables.
  const toml::table& element(std::string_view list, size_t index) const;

  // Changes the table from `base`, the values of the text, to `edited`. Equal values keep their text, and new keys are
  // added unless they are omissible.
  void change(const toml::table& table, const std::vector<KeyText>& base, const std::vector<KeyText>& edited);
  // Adds [name] behind the last of the tables `after` that the text has.
  void addSection(const std::string& name, const std::vector<std::string>& after, const std::vector<KeyText>& keys);
  // Adds an element at the end of the file's array `list`, which the text may lack.
  void addElement(const std::string& list, const std::vector<KeyText>& keys);
  void setValue(const toml::node& value, const std::string& text);
  void addKey(const toml::table& table, const std::string& key, const std::string& text);
  // Removes a value, or a table with its headers and the comments right above them.
  void remove(const toml::node& node);

  // Returns the text with the changes.
  std::string text() const;

 private:
  struct Edit {
    TomlLayout::TextRange range;
    std::string text;
    bool block = false;  // begins with a blank line
  };
  // Changes of the items in braces or brackets.
  struct ListChange {
    std::set<const toml::node*> removed;
    std::vector<std::string> added;
  };
  void changeKey(const toml::table& table, const std::vector<KeyText>& base, const KeyText& key);
  void replaceChangedNumbers(const toml::node& value, std::string_view base, std::string_view edited);
  std::string wrappedPoints(std::string_view value, size_t before) const;
  void removeSection(const toml::table& table);
  void addBlock(size_t at, const std::string& header, const std::vector<KeyText>& keys);
  void resolve(const toml::node& list, const ListChange& change, std::vector<Edit>& edits) const;

  TomlLayout toml_;
  std::vector<Edit> edits_;
  std::map<const toml::node*, ListChange> lists_;
};

}  // namespace speculum
