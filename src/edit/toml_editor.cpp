#include "edit/toml_editor.hpp"

#include <spdlog/fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <stdexcept>
#include <tuple>

#include "platform/text.hpp"
#include "scene/toml_file.hpp"

namespace speculum {

namespace {

bool isInBraces(const toml::node& node) {
  return node.is_table() && node.as_table()->is_inline();
}

bool isArrayOfHeaders(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array && array->is_array_of_tables() && array->front().source().begin == array->source().begin;
}

// Says whether only headers of nested tables name the table. Such a table has the position of the first of these
// headers.
bool isImplicit(const toml::table& table) {
  return std::ranges::any_of(table, [&](const auto& entry) {
    const bool headed = entry.second.is_table() || isArrayOfHeaders(entry.second);
    return headed && entry.second.source().begin == table.source().begin;
  });
}

constexpr size_t longestLine = 120;

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
  return items.empty() ? "{}" : fmt::format("{{ {} }}", fmt::join(items, ", "));
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

// Returns the elements of an array as tomlText() writes it; none of any other value.
std::vector<std::string_view> elementsOf(std::string_view value) {
  std::vector<std::string_view> elements;
  if (!value.starts_with('[')) {
    return elements;
  }
  int depth = 0;
  size_t begin = 1;
  for (size_t i = 0; i < value.size(); ++i) {
    depth += value[i] == '[' ? 1 : 0;
    if (depth == 1 && (value[i] == ',' || value[i] == ']') && i > begin) {
      elements.push_back(value.substr(begin, i - begin));
      begin = i + 2;
    }
    depth -= value[i] == ']' ? 1 : 0;
  }
  return elements;
}

// Says whether the node stands after an = or in brackets; other tables are made by headers and dotted keys.
bool isValue(const toml::node& node) {
  return node.is_table() ? isInBraces(node) : !isArrayOfHeaders(node);
}

}  // namespace

TomlLayout::TomlLayout(std::string text) : text_(std::move(text)) {
  const size_t first = text_.find('\n');
  lineBreak_ = first != std::string::npos && first > 0 && text_[first - 1] == '\r' ? "\r\n" : "\n";
  endsInLineBreak_ = text_.empty() || text_.back() == '\n';
  text_ += endsInLineBreak_ ? "" : lineBreak_;
  lines_.push_back(text_.starts_with("\xef\xbb\xbf") ? 3 : 0);
  for (size_t i = 0; i < text_.size(); ++i) {
    if (text_[i] == '\n') {
      lines_.push_back(i + 1);
    }
  }
  root_ = toml::parse(text_);
  recordPlaces(root_, nullptr);
}

void TomlLayout::recordPlaces(const toml::node& node, const toml::node* list) {
  forEachChild(node, [&](const toml::key* key, const toml::node& child) {
    places_[&child] = {&node, key, list};
    linedUp_ = linedUp_ || (list == nullptr && isValue(child) && statementOf(child).linedUp);
    recordPlaces(child, isValue(child) ? &child : list);
  });
}

// Returns the byte at a line and column. Columns count code points.
size_t TomlLayout::offset(const toml::source_position& position) const {
  size_t at = lines_.at(position.line - 1);
  for (uint32_t column = 1; column < position.column; ++column) {
    ++at;
    while (at < text_.size() && continuesCharacter(text_[at])) {
      ++at;
    }
  }
  return at;
}

// Returns the whole lines of a region, the last line break included.
TomlLayout::TextRange TomlLayout::linesOf(const toml::source_region& region) const {
  return {lines_.at(region.begin.line - 1), std::min(text_.find('\n', offset(region.end)), text_.size() - 1) + 1};
}

std::string_view TomlLayout::line(size_t begin) const {
  const size_t end = std::min(text_.find('\n', begin), text_.size());
  std::string_view line = std::string_view(text_).substr(begin, end - begin);
  line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
  return line;
}

bool TomlLayout::isDotted(const toml::node& node) const {
  return node.is_table() && !isInBraces(node) && &node != &root_ && text_[offset(node.source().begin)] != '[';
}

bool TomlLayout::hasHeader(const toml::node& node) const {
  return &node == &root_ || (node.is_table() && !isInBraces(node) && !isDotted(node) && !isImplicit(*node.as_table()));
}

TomlLayout::Statement TomlLayout::statementOf(const toml::node& value) const {
  const toml::source_region& key = places_.at(&value).key->source();
  const TextRange lines{linesOf(key).begin, linesOf(value.source()).end};
  const size_t keyEnd = offset(key.end);
  const size_t equals = text_.find('=', keyEnd);
  return {lines, equals - text_.find_first_not_of(" \t", lines.begin), equals > keyEnd + 1};
}

std::vector<TomlLayout::Statement> TomlLayout::statementsOf(const toml::table& table) const {
  std::vector<Statement> statements;
  for (const auto& [key, child] : table) {
    if (isValue(child)) {
      statements.push_back(statementOf(child));
    } else if (isDotted(child)) {
      const std::vector<Statement> inner = statementsOf(*child.as_table());
      statements.insert(statements.end(), inner.begin(), inner.end());
    }
  }
  std::ranges::sort(statements, {}, [](const Statement& statement) { return statement.lines.begin; });
  return statements;
}

TomlLayout::TextRange TomlLayout::sectionOf(const toml::table& table) const {
  const TextRange header = &table == &root_ ? TextRange{lines_.front(), lines_.front()} : linesOf(table.source());
  const std::vector<Statement> statements = statementsOf(table);
  return {header.begin, statements.empty() ? header.end : statements.back().lines.end};
}

size_t TomlLayout::contentEnd(const toml::table& table) const {
  const size_t sectionEnd = sectionOf(table).end;
  size_t end = sectionEnd;
  while (end < text_.size() && line(end).starts_with('#')) {
    end = std::min(text_.find('\n', end), text_.size() - 1) + 1;
  }
  return end < text_.size() && line(end).starts_with('[') ? sectionEnd : end;
}

size_t TomlLayout::endOfTables(const toml::node& node) const {
  size_t end = hasHeader(node) ? contentEnd(*node.as_table()) : 0;
  forEachChild(node, [&](const toml::key*, const toml::node& child) { end = std::max(end, endOfTables(child)); });
  return end;
}

std::vector<const toml::node*> TomlLayout::itemsOf(const toml::node& list) const {
  std::vector<const toml::node*> items;
  forEachChild(list, [&](const toml::key*, const toml::node& child) {
    const std::vector<const toml::node*> own = isValue(child) ? std::vector{&child} : itemsOf(child);
    items.insert(items.end(), own.begin(), own.end());
  });
  std::ranges::sort(items, std::less<>(), [](const toml::node* item) { return item->source().begin; });
  return items;
}

size_t TomlLayout::commaEnd(size_t at) const {
  size_t comma = text_.find_first_not_of(" \t\r\n", at);
  while (text_[comma] == '#') {
    comma = text_.find_first_not_of(" \t\r\n", text_.find('\n', comma));
  }
  return text_[comma] == ',' ? comma + 1 : at;
}

const toml::table& TomlEditor::element(std::string_view list, size_t index) const {
  return *root().get_as<toml::array>(list)->get_as<toml::table>(index);
}

void TomlEditor::change(const toml::table& table, const std::vector<KeyText>& base,
                        const std::vector<KeyText>& edited) {
  for (const KeyText& key : base) {
    const toml::table* within = key.table.empty() ? &table : table.get_as<toml::table>(key.table);
    if (within == nullptr || find(edited, key) != nullptr) {
      continue;
    }
    if (!key.table.empty() && !hasTable(edited, key.table)) {
      remove(*within);
    } else if (const toml::node* value = within->get(key.key)) {
      remove(*value);
    }
  }
  for (const auto& [key, text] : statements(edited)) {
    if (hasTable(edited, key) && !table.contains(key)) {
      addKey(table, key, text);
    }
  }
  for (const KeyText& key : edited) {
    changeKey(table, base, key);
  }
}

void TomlEditor::changeKey(const toml::table& table, const std::vector<KeyText>& base, const KeyText& key) {
  const KeyText* before = find(base, key);
  const toml::table* within = key.table.empty() ? &table : table.get_as<toml::table>(key.table);
  if (within == nullptr || (before != nullptr && before->text == key.text)) {
    return;
  }
  if (const toml::node* value = within->get(key.key)) {
    replaceChangedNumbers(*value, before ? before->text : std::string(), key.text);
  } else if (!key.omissible) {
    addKey(*within, key.key, key.text);
  }
}

void TomlEditor::setValue(const toml::node& value, const std::string& text) {
  edits_.push_back({toml_.rangeOf(value), text});
}

// Leaves the numbers of an array that did not change as they are written.
void TomlEditor::replaceChangedNumbers(const toml::node& value, std::string_view base, std::string_view edited) {
  if (base == edited) {
    return;
  }
  const toml::array* array = value.as_array();
  const std::vector<std::string_view> before = elementsOf(base);
  const std::vector<std::string_view> after = elementsOf(edited);
  if (base.empty() || !array || before.size() != after.size() || array->size() != after.size()) {
    setValue(value, base.empty() ? std::string(edited) : wrappedPoints(edited, 0));
    return;
  }
  for (size_t i = 0; i < after.size(); ++i) {
    replaceChangedNumbers((*array)[i], before[i], after[i]);
  }
}

// Breaks a list of points into lines if it is too long for one.
std::string TomlEditor::wrappedPoints(std::string_view value, size_t before) const {
  if (!value.starts_with("[[") || before + value.size() <= longestLine) {
    return std::string(value);
  }
  std::string text = "[" + toml_.lineBreak();
  for (const std::string_view point : elementsOf(value)) {
    text.append("  ").append(point).append(",").append(toml_.lineBreak());
  }
  return text + "]";
}

void TomlEditor::addKey(const toml::table& table, const std::string& key, const std::string& text) {
  if (table.is_inline()) {
    lists_[&table].added.push_back(keyValue(key, 0, text));
    return;
  }
  const bool headed = toml_.hasHeader(table);
  // The key of a table without a header becomes a dotted one: below the table's others, or else in the table around it.
  if (!headed && (!toml_.isDotted(table) || toml_.placeOf(table).list)) {
    const TomlLayout::Place& place = toml_.placeOf(table);
    return addKey(*place.within->as_table(), tomlKey(place.key->str()) + "." + key, text);
  }
  std::string name = key;
  for (const toml::node* outer = &table; toml_.isDotted(*outer); outer = toml_.placeOf(*outer).within) {
    name = tomlKey(toml_.placeOf(*outer).key->str()) + "." + name;
  }
  const std::vector<TomlLayout::Statement> statements = toml_.statementsOf(table);
  const size_t at = headed ? toml_.sectionOf(table).end : statements.back().lines.end;
  std::string indent;
  if (!statements.empty()) {
    const size_t begin = statements.back().lines.begin;
    indent = toml_.text().substr(begin, toml_.text().find_first_not_of(" \t", begin) - begin);
  }
  const bool linedUp = headed && std::ranges::any_of(statements, &TomlLayout::Statement::linedUp);
  const size_t width = linedUp ? statements.back().keyWidth : 0;
  const std::string value = wrappedPoints(text, indent.size() + std::max(width, name.size() + 1) + 2);
  edits_.push_back({{at, at}, indent + keyValue(name, width, value) + toml_.lineBreak()});
}

void TomlEditor::remove(const toml::node& node) {
  const TomlLayout::Place& place = toml_.placeOf(node);
  if (isValue(node) && place.list) {
    lists_[place.list].removed.insert(&node);
  } else if (isValue(node)) {
    edits_.push_back({toml_.statementOf(node).lines, ""});
  } else {
    const bool headed = toml_.hasHeader(node);
    if (headed) {
      removeSection(*node.as_table());
    }
    forEachChild(node, [&](const toml::key*, const toml::node& child) {
      // Removing a header also removes the statements under it.
      if (!headed || !isValue(child)) {
        remove(child);
      }
    });
  }
}

void TomlEditor::removeSection(const toml::table& table) {
  const auto lineBefore = [&](size_t at) { return at < 2 ? 0 : toml_.text().rfind('\n', at - 2) + 1; };
  size_t begin = toml_.sectionOf(table).begin;
  while (begin > 0 && toml_.line(lineBefore(begin)).starts_with('#')) {
    begin = lineBefore(begin);
  }
  while (begin > 0 && toml_.line(lineBefore(begin)).empty()) {
    begin = lineBefore(begin);
  }
  edits_.push_back({{begin, toml_.contentEnd(table)}, ""});
}

void TomlEditor::addBlock(size_t at, const std::string& header, const std::vector<KeyText>& keys) {
  const auto lines = statements(keys);
  size_t width = 0;
  for (const auto& [key, value] : lines) {
    width = std::max(width, toml_.linedUp() ? key.size() + 1 : 0);
  }
  std::string text = toml_.lineBreak() + header + toml_.lineBreak();
  for (const auto& [key, value] : lines) {
    text += keyValue(key, width, wrappedPoints(value, std::max(width, key.size() + 1) + 2)) + toml_.lineBreak();
  }
  const bool blankBelow = at == toml_.text().size() || toml_.line(at).empty();
  edits_.push_back({{at, at}, text + (blankBelow ? "" : toml_.lineBreak()), true});
}

void TomlEditor::addSection(const std::string& name, const std::vector<std::string>& after,
                            const std::vector<KeyText>& keys) {
  size_t at = toml_.sectionOf(root()).end;
  for (const std::string& other : after) {
    const toml::node* table = root().get(other);
    at = std::max(at, table != nullptr ? toml_.endOfTables(*table) : 0);
  }
  addBlock(at, "[" + name + "]", keys);
}

void TomlEditor::addElement(const std::string& list, const std::vector<KeyText>& keys) {
  const toml::node* known = root().get(list);
  if (known != nullptr && isValue(*known)) {
    std::vector<std::string> items;
    for (const auto& [key, value] : statements(keys)) {
      items.push_back(keyValue(key, 0, value));
    }
    lists_[known].added.push_back(inBraces(items));
    return;
  }
  addBlock(known != nullptr ? toml_.endOfTables(*known) : toml_.text().size(), "[[" + list + "]]", keys);
}

// Removes a run of items with the comma behind it, or at the end of the list with the comma before it. A list that
// becomes empty loses all commas, since none may stand there alone.
void TomlEditor::resolve(const toml::node& list, const ListChange& change, std::vector<Edit>& edits) const {
  const std::vector<const toml::node*> items = toml_.itemsOf(list);
  std::vector<TomlLayout::TextRange> ranges;
  size_t end = toml_.rangeOf(list).begin + 1;
  for (const toml::node* item : items) {
    // Keys in braces begin behind the brace or the comma.
    const size_t key = toml_.text().find_first_not_of(" \t,", end);
    ranges.push_back(toml_.rangeOf(*item));
    ranges.back().begin = list.is_table() ? key : ranges.back().begin;
    end = ranges.back().end;
  }
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
    const bool emptied = last && first == 0 && change.added.empty();
    const size_t begin = last && first > 0 ? ranges[first - 1].end : ranges[first].begin;
    edits.push_back({{begin, emptied ? toml_.commaEnd(end) : last ? end : ranges[i + 1].begin}, ""});
  }
  std::string added;
  for (const std::string& item : change.added) {
    added += (kept ? ", " : added.empty() ? " " : ", ") + item;
  }
  if (!added.empty()) {
    const bool closes = items.empty() && toml_.text()[end] != ' ';
    edits.push_back({{end, end}, added + (closes ? " " : "")});
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
    result.append(toml_.text(), at, edit.range.begin - at);
    const bool blankAbove = result.ends_with(toml_.lineBreak() + toml_.lineBreak());
    result.append(edit.text, edit.block && blankAbove ? toml_.lineBreak().size() : 0);
    at = edit.range.end;
  }
  result.append(toml_.text(), at);
  if (!toml_.endsInLineBreak() && result.ends_with(toml_.lineBreak())) {
    result.resize(result.size() - toml_.lineBreak().size());
  }
  return result;
}

}  // namespace speculum
