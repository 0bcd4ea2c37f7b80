#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "edit/scene_keys.hpp"
#include "edit/toml_outline.hpp"

namespace speculum {

// Changes values in the text of a TOML file and keeps everything else: comments, order, blanks, line breaks. Nodes are
// those of outline(); text() applies the changes collected so far.
class TomlEditor {
 public:
  // `text` must have been parsed without an error.
  explicit TomlEditor(std::string text);

  TomlNode& outline() { return root_; }

  // Changes the table from `base`, the values of the text, to `edited`. Equal values keep their text, and new keys are
  // added unless they are omissible.
  void change(TomlNode& table, const std::vector<KeyText>& base, const std::vector<KeyText>& edited);
  // Adds [name] behind the last of the tables `after` that the text has.
  void addSection(const std::string& name, const std::vector<std::string>& after, const std::vector<KeyText>& keys);
  // Removes an element of the file's array `list`, with the comment right above it.
  void removeElement(const std::string& list, size_t index) { remove(*root_.child(list)->children.at(index)); }
  // Adds an element at the end of the file's array `list`, which the text may lack.
  void addElement(const std::string& list, const std::vector<KeyText>& keys);
  void setValue(const TomlNode& value, const std::string& text) { edits_.push_back({value.value.value(), text}); }
  // Adds a key to the last of `tables`, a path of nested tables. Only the last may be missing from the text.
  void addKey(const std::vector<TomlNode*>& tables, const std::string& key, const std::string& text);
  void remove(TomlNode& node);

  // The text with the changes.
  std::string text() const;

 private:
  struct Edit {
    TextRange range;
    std::string text;
    bool block = false;  // begins with a blank line
  };
  // Changes of the items in braces or brackets.
  struct ListChange {
    std::set<const TomlNode*> removed;
    std::vector<std::string> added;
  };

  void recordOwners(const TomlNode& node, const TomlNode* list);
  void changeKey(TomlNode& table, const std::vector<KeyText>& base, const KeyText& key);
  void replaceChangedNumbers(const TomlNode& value, const std::string& base, const std::string& edited);
  void removeSection(const TomlSection& section);
  size_t endOfTable(const TomlNode& table) const;
  size_t contentEnd(const TomlSection& section) const;
  void addBlock(size_t at, const std::string& header, const std::vector<KeyText>& keys);
  void resolve(const TomlNode& list, const ListChange& change, std::vector<Edit>& edits) const;
  std::string_view line(size_t begin) const;

  std::string text_;
  bool endsInLineBreak_ = true;
  std::string lineBreak_ = "\n";
  bool linedUp_ = false;  // in any section
  TomlNode root_;
  std::vector<Edit> edits_;
  std::map<const TomlNode*, const TomlNode*> owners_;  // the braces or brackets around a node
  std::map<const TomlNode*, ListChange> lists_;
};

}  // namespace speculum
