#include "edit/toml_layout.hpp"

#include <algorithm>
#include <functional>

#include "platform/text.hpp"

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

}  // namespace

bool isValue(const toml::node& node) {
  return node.is_table() ? isInBraces(node) : !isArrayOfHeaders(node);
}

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

}  // namespace speculum
