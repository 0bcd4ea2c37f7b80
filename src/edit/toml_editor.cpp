#include "edit/toml_editor.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include "scene/toml_text.hpp"

namespace speculum {

namespace {

constexpr size_t kLongestLine = 120;

const KeyText* find(const std::vector<KeyText>& keys, const KeyText& wanted) {
  const auto found =
      std::ranges::find_if(keys, [&](const KeyText& k) { return k.table == wanted.table && k.key == wanted.key; });
  return found == keys.end() ? nullptr : &*found;
}

bool hasTable(const std::vector<KeyText>& keys, const std::string& table) {
  return std::ranges::any_of(keys, [&](const KeyText& k) { return k.table == table; });
}

std::string keyValue(const std::string& key, size_t width, const std::string& value) {
  return key + std::string(key.size() < width ? width - key.size() : 1, ' ') + "= " + value;
}

std::string inBraces(const std::vector<std::string>& items) {
  std::string text;
  for (const std::string& item : items) {
    text += (text.empty() ? " " : ", ") + item;
  }
  return "{" + text + (items.empty() ? "}" : " }");
}

// Writes the keys of a nested table as one value in braces; empty if all may be omitted.
std::string bracesText(const std::vector<KeyText>& keys, const std::string& table) {
  std::vector<std::string> items;
  for (const KeyText& key : keys) {
    if (key.table == table && !key.omissible) {
      items.push_back(keyValue(key.key, 0, key.text));
    }
  }
  return items.empty() ? std::string() : inBraces(items);
}

// Returns the keys and values to write, nested tables in braces, without omissible keys.
std::vector<std::pair<std::string, std::string>> statements(const std::vector<KeyText>& keys) {
  std::vector<std::pair<std::string, std::string>> list;
  for (size_t i = 0; i < keys.size(); ++i) {
    const KeyText& key = keys[i];
    if (key.table.empty() && !key.omissible) {
      list.emplace_back(key.key, key.text);
    } else if (!key.table.empty() && (i == 0 || keys[i - 1].table != key.table)) {
      if (const std::string text = bracesText(keys, key.table); !text.empty()) {
        list.emplace_back(key.table, text);
      }
    }
  }
  return list;
}

// Breaks a list of points into lines if it is too long for one.
std::string wrappedPoints(const std::string& value, size_t before, const std::string& lineBreak) {
  if (!value.starts_with("[[") || before + value.size() <= kLongestLine) {
    return value;
  }
  const TomlNode points = outlineOfValue(value);
  std::string text = "[" + lineBreak;
  for (const auto& point : points.children) {
    text.append("  ").append(point->value->of(value)).append(",").append(lineBreak);
  }
  return text + "]";
}

TextRange itemRange(const TomlNode& item) {
  return item.keyed ? *item.keyed : item.value.value();
}

}  // namespace

TomlEditor::TomlEditor(std::string text) : text_(std::move(text)) {
  const size_t first = text_.find('\n');
  lineBreak_ = first != std::string::npos && first > 0 && text_[first - 1] == '\r' ? "\r\n" : "\n";
  endsInLineBreak_ = text_.empty() || text_.back() == '\n';
  text_ += endsInLineBreak_ ? "" : lineBreak_;
  root_ = outlineOf(text_);
  recordOwners(root_, nullptr);
}

void TomlEditor::recordOwners(const TomlNode& node, const TomlNode* list) {
  owners_[&node] = list;
  linedUp_ = linedUp_ || (node.section && node.section->linedUp);
  const TomlNode* inner = node.value && node.kind != TomlNode::Kind::scalar ? &node : list;
  for (const auto& child : node.children) {
    recordOwners(*child, inner);
  }
}

std::string_view TomlEditor::line(size_t begin) const {
  const size_t end = std::min(text_.find('\n', begin), text_.size());
  std::string_view line = std::string_view(text_).substr(begin, end - begin);
  line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
  return line;
}

void TomlEditor::change(TomlNode& table, const std::vector<KeyText>& base, const std::vector<KeyText>& edited) {
  for (const KeyText& key : base) {
    TomlNode* within = key.table.empty() ? &table : table.child(key.table);
    if (within == nullptr || find(edited, key) != nullptr) {
      continue;
    }
    if (!key.table.empty() && !hasTable(edited, key.table)) {
      remove(*within);
    } else if (TomlNode* value = within->child(key.key)) {
      remove(*value);
    }
  }
  for (const auto& [key, text] : statements(edited)) {
    if (hasTable(edited, key) && table.child(key) == nullptr) {
      addKey({&table}, key, text);
    }
  }
  for (const KeyText& key : edited) {
    changeKey(table, base, key);
  }
}

void TomlEditor::changeKey(TomlNode& table, const std::vector<KeyText>& base, const KeyText& key) {
  const KeyText* before = find(base, key);
  TomlNode* within = key.table.empty() ? &table : table.child(key.table);
  if (within == nullptr || (before != nullptr && before->text == key.text)) {
    return;
  }
  if (const TomlNode* value = within->child(key.key)) {
    replaceChangedNumbers(*value, before ? before->text : std::string(), key.text);
  } else if (!key.omissible) {
    addKey(within == &table ? std::vector{&table} : std::vector{&table, within}, key.key, key.text);
  }
}

// Leaves the numbers of an array that did not change as they are written.
void TomlEditor::replaceChangedNumbers(const TomlNode& value, const std::string& base, const std::string& edited) {
  const auto compare = [&](const auto& self, const TomlNode& here, const TomlNode& was, const TomlNode& becomes) {
    const std::string_view text = becomes.value->of(edited);
    if (was.value->of(base) == text) {
      return;
    }
    const size_t count = becomes.children.size();
    if (becomes.kind != TomlNode::Kind::array || here.kind != becomes.kind || was.kind != becomes.kind ||
        here.children.size() != count || was.children.size() != count) {
      setValue(here, wrappedPoints(std::string(text), 0, lineBreak_));
      return;
    }
    for (size_t i = 0; i < count; ++i) {
      self(self, *here.children[i], *was.children[i], *becomes.children[i]);
    }
  };
  if (base.empty()) {
    setValue(value, edited);
  } else {
    compare(compare, value, outlineOfValue(base), outlineOfValue(edited));
  }
}

void TomlEditor::addKey(const std::vector<TomlNode*>& tables, const std::string& key, const std::string& text) {
  const TomlNode& table = *tables.back();
  if (table.inBraces()) {
    lists_[&table].added.push_back(keyValue(key, 0, text));
    return;
  }
  if (!table.section && !table.dotted) {
    std::vector<TomlNode*> outer(tables.begin(), tables.end() - 1);
    if (outer.empty() && root_.child(table.key) == &table) {
      outer.push_back(&root_);
    }
    if (outer.empty()) {
      throw std::logic_error("a table without a place in the text");
    }
    return addKey(outer, tomlKey(table.key) + "." + key, text);
  }
  // Adds the key under the table's header, or else below the last dotted key.
  const std::optional<TomlSection>& section = table.section;
  const size_t at = section ? section->end : table.dotted->end;
  const std::optional<TextRange> last = section ? section->lastStatement : table.dotted;
  std::string indent;
  if (last) {
    const size_t blanks = text_.find_first_not_of(" \t", last->begin) - last->begin;
    indent = text_.substr(last->begin, blanks);
  }
  const std::string name = section ? key : table.dottedPrefix + key;
  const size_t width = section && section->linedUp ? section->keyWidth : 0;
  const std::string value = wrappedPoints(text, indent.size() + std::max(width, name.size() + 1) + 2, lineBreak_);
  edits_.push_back({{at, at}, indent + keyValue(name, width, value) + lineBreak_});
}

void TomlEditor::remove(TomlNode& node) {
  const TomlNode* list = owners_.at(&node);
  if (node.statement) {
    edits_.push_back({*node.statement, ""});
  } else if (list != nullptr && node.value) {
    lists_[list].removed.insert(&node);
  } else {
    if (node.section) {
      removeSection(*node.section);
    }
    for (const auto& child : node.children) {
      // Removing a header also removes the statements under it.
      if (!node.section || !child->statement) {
        remove(*child);
      }
    }
  }
}

// Returns the end of a section, including comments right after it unless they belong to a header right below.
size_t TomlEditor::contentEnd(const TomlSection& section) const {
  size_t end = section.end;
  while (end < text_.size() && line(end).starts_with('#')) {
    end = std::min(text_.find('\n', end), text_.size() - 1) + 1;
  }
  return end < text_.size() && line(end).starts_with('[') ? section.end : end;
}

void TomlEditor::removeSection(const TomlSection& section) {
  const auto lineBefore = [&](size_t at) { return at < 2 ? 0 : text_.rfind('\n', at - 2) + 1; };
  size_t begin = section.begin;
  while (begin > 0 && line(lineBefore(begin)).starts_with('#')) {
    begin = lineBefore(begin);
  }
  while (begin > 0 && line(lineBefore(begin)).empty()) {
    begin = lineBefore(begin);
  }
  edits_.push_back({{begin, contentEnd(section)}, ""});
}

size_t TomlEditor::endOfTable(const TomlNode& table) const {
  size_t end = 0;
  if (table.section) {
    end = contentEnd(*table.section);
  }
  for (const auto& child : table.children) {
    end = std::max(end, endOfTable(*child));
  }
  return end;
}

void TomlEditor::addBlock(size_t at, const std::string& header, const std::vector<KeyText>& keys) {
  const auto lines = statements(keys);
  size_t width = 0;
  for (const auto& [key, value] : lines) {
    width = std::max(width, linedUp_ ? key.size() + 1 : 0);
  }
  std::string text = lineBreak_ + header + lineBreak_;
  for (const auto& [key, value] : lines) {
    text += keyValue(key, width, wrappedPoints(value, std::max(width, key.size() + 1) + 2, lineBreak_)) + lineBreak_;
  }
  const bool blankBelow = at == text_.size() || line(at).empty();
  edits_.push_back({{at, at}, text + (blankBelow ? "" : lineBreak_), true});
}

void TomlEditor::addSection(const std::string& name, const std::vector<std::string>& after,
                            const std::vector<KeyText>& keys) {
  size_t at = root_.section->end;
  for (const std::string& other : after) {
    const TomlNode* table = root_.child(other);
    at = std::max(at, table != nullptr ? endOfTable(*table) : 0);
  }
  addBlock(at, "[" + name + "]", keys);
}

void TomlEditor::addElement(const std::string& list, const std::vector<KeyText>& keys) {
  const TomlNode* known = root_.child(list);
  if (known != nullptr && known->value) {
    std::vector<std::string> items;
    for (const auto& [key, value] : statements(keys)) {
      items.push_back(keyValue(key, 0, value));
    }
    lists_[known].added.push_back(inBraces(items));
    return;
  }
  const size_t at = known != nullptr ? endOfTable(*known) : text_.size();
  addBlock(at, "[[" + list + "]]", keys);
}

// Removes a run of items with the comma behind it, or at the end of the list with the comma before it.
void TomlEditor::resolve(const TomlNode& list, const ListChange& change, std::vector<Edit>& edits) const {
  const std::vector<TomlNode*> items = itemsOf(list);
  const auto removed = [&](size_t i) { return change.removed.contains(items[i]); };
  bool kept = false;
  for (size_t i = 0; i < items.size(); ++i) {
    if (!removed(i)) {
      kept = true;
      continue;
    }
    const size_t first = i;
    while (i + 1 < items.size() && removed(i + 1)) {
      ++i;
    }
    const bool last = i + 1 == items.size();
    const size_t begin = last && first > 0 ? itemRange(*items[first - 1]).end : itemRange(*items[first]).begin;
    edits.push_back({{begin, last ? itemRange(*items[i]).end : itemRange(*items[i + 1]).begin}, ""});
  }
  std::string added;
  for (const std::string& item : change.added) {
    added += (kept ? ", " : added.empty() ? " " : ", ") + item;
  }
  if (!added.empty()) {
    const size_t at = items.empty() ? list.value->begin + 1 : itemRange(*items.back()).end;
    const bool closes = items.empty() && text_[at] != ' ';
    edits.push_back({{at, at}, added + (closes ? " " : "")});
  }
}

std::string TomlEditor::text() const {
  std::vector<Edit> edits = edits_;
  for (const auto& [list, change] : lists_) {
    resolve(*list, change, edits);
  }
  // Keys added to a table come before a table that is added behind it.
  std::ranges::stable_sort(edits, [](const Edit& a, const Edit& b) {
    return std::tuple(a.range.begin, a.range.end, a.block) < std::tuple(b.range.begin, b.range.end, b.block);
  });
  std::string result;
  size_t at = 0;
  for (const Edit& edit : edits) {
    // Skips a range within a larger one that is removed.
    if (edit.text.empty() && edit.range.end <= at) {
      continue;
    }
    if (edit.range.begin < at) {
      throw std::logic_error("changes of a text overlap");
    }
    result.append(text_, at, edit.range.begin - at);
    const bool blankAbove = result.ends_with(lineBreak_ + lineBreak_);
    result.append(edit.text, edit.block && blankAbove ? lineBreak_.size() : 0);
    at = edit.range.end;
  }
  result.append(text_, at);
  if (!endsInLineBreak_ && result.ends_with(lineBreak_)) {
    result.resize(result.size() - lineBreak_.size());
  }
  return result;
}

}  // namespace speculum
