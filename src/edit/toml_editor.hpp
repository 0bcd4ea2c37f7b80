#pragma once

#include <toml++/toml.h>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// Calls visit(key, child) for each child of a table or array; the key is null for elements.
template <typename Visitor>
void forEachChild(const toml::node& node, const Visitor& visit) {
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, child] : *table) {
      visit(&key, child);
    }
  } else if (const toml::array* array = node.as_array()) {
    for (const toml::node& child : *array) {
      visit(nullptr, child);
    }
  }
}

// Says where a TOML file's text has the nodes of its tree. Positions are bytes of the text.
class TomlLayout {
 public:
  // Bytes begin .. end - 1 of the text.
  struct TextRange {
    size_t begin = 0;
    size_t end = 0;
  };
  // Where the tree has a node.
  struct Place {
    const toml::node* within = nullptr;  // table or array
    const toml::key* key = nullptr;      // of the node, if `within` is a table
    const toml::node* list = nullptr;    // the braces or brackets around the node, if there are any
  };
  // `key = value` on lines of its own.
  struct Statement {
    TextRange lines;
    size_t keyWidth = 0;   // bytes from the key to its =
    bool linedUp = false;  // the key is padded, so that the = of several keys stand below each other
  };

  // `text` must have been parsed without an error.
  explicit TomlLayout(std::string text);

  const toml::table& root() const { return root_; }
  const std::string& text() const { return text_; }  // ends in a line break
  const std::string& lineBreak() const { return lineBreak_; }
  bool endsInLineBreak() const { return endsInLineBreak_; }  // the text did, before a line break was added
  bool linedUp() const { return linedUp_; }                  // some statement is lined up

  const Place& placeOf(const toml::node& node) const { return places_.at(&node); }
  TextRange rangeOf(const toml::node& node) const { return {offset(node.source().begin), offset(node.source().end)}; }
  std::string_view line(size_t begin) const;     // the line from byte `begin` on, without leading blanks
  bool isDotted(const toml::node& node) const;   // dotted keys make the table
  bool hasHeader(const toml::node& node) const;  // the table has a header of its own, or is the root
  Statement statementOf(const toml::node& value) const;
  // Statements under the table's header, or those whose dotted keys add to it, in the order of the text.
  std::vector<Statement> statementsOf(const toml::table& table) const;
  TextRange sectionOf(const toml::table& table) const;  // from the header to the last statement under it
  // End of a section, including comments right after it unless they belong to a header right below.
  size_t contentEnd(const toml::table& table) const;
  size_t endOfTables(const toml::node& node) const;  // of the last section in the node; 0 if there is none
  // Items of braces or brackets, which commas separate, in the order of the text: the values within, past tables that
  // dotted keys make.
  std::vector<const toml::node*> itemsOf(const toml::node& list) const;
  // End of the comma behind an item that ends at `at`, past blanks and comments; `at` if there is none.
  size_t commaEnd(size_t at) const;

 private:
  void recordPlaces(const toml::node& node, const toml::node* list);
  size_t offset(const toml::source_position& position) const;
  TextRange linesOf(const toml::source_region& region) const;

  std::string text_;
  bool endsInLineBreak_ = true;
  std::string lineBreak_ = "\n";
  std::vector<size_t> lines_;  // where each line begins
  toml::table root_;
  std::map<const toml::node*, Place> places_;
  bool linedUp_ = false;
};

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
