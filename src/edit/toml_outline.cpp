#include "edit/toml_outline.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <utility>

#include "scene/toml_text.hpp"

namespace speculum {

namespace {

// Line and column, from 1.
using Position = std::pair<uint32_t, uint32_t>;

Position beginOf(const toml::source_region& region) {
  return {region.begin.line, region.begin.column};
}

bool isArrayOfHeaders(const toml::node& node) {
  const toml::array* array = node.as_array();
  return array && array->is_array_of_tables() && beginOf(array->front().source()) == beginOf(array->source());
}

// Says whether only headers of nested tables name the table; it then has the position of the first of them.
bool isImplicit(const toml::table& table) {
  return std::ranges::any_of(table, [&](const auto& entry) {
    const bool headed = entry.second.is_table() || isArrayOfHeaders(entry.second);
    return headed && beginOf(entry.second.source()) == beginOf(table.source());
  });
}

// Turns the parser's tree, whose nodes have positions, into ranges of bytes.
class Outliner {
 public:
  explicit Outliner(std::string text) : text_(std::move(text)) {
    lines_.push_back(text_.starts_with("\xef\xbb\xbf") ? 3 : 0);
    for (size_t i = 0; i < text_.size(); ++i) {
      if (text_[i] == '\n') {
        lines_.push_back(i + 1);
      }
    }
  }

  TomlNode file() {
    TomlNode root;
    root.section = TomlSection{.begin = lines_.front(), .end = lines_.front()};
    section_ = &*root.section;
    addChildren(root, toml::parse(text_));
    return root;
  }

  TomlNode value(const std::string& key) {
    TomlNode node;
    const toml::table parsed = toml::parse(text_);
    addValue(node, *parsed.get(key));
    return node;
  }

 private:
  // Returns the byte at a line and column. Columns count code points.
  size_t offset(const toml::source_position& position) const {
    size_t at = lines_.at(position.line - 1);
    for (uint32_t column = 1; column < position.column; ++column) {
      ++at;
      while (at < text_.size() && (static_cast<unsigned char>(text_[at]) & 0xc0) == 0x80) {
        ++at;
      }
    }
    return at;
  }

  TextRange range(const toml::source_region& region) const { return {offset(region.begin), offset(region.end)}; }

  TextRange linesOf(const toml::source_region& region) const {
    const size_t end = text_.find('\n', offset(region.end));
    return {lines_.at(region.begin.line - 1), end == std::string_view::npos ? text_.size() : end + 1};
  }

  void addChildren(TomlNode& node, const toml::table& table) {
    std::vector<std::pair<const toml::key*, const toml::node*>> entries;
    for (const auto& [key, child] : table) {
      entries.emplace_back(&key, &child);
    }
    std::ranges::sort(
        entries, [](const auto& a, const auto& b) { return beginOf(a.first->source()) < beginOf(b.first->source()); });
    for (const auto& [key, child] : entries) {
      TomlNode& added = *node.children.emplace_back(std::make_unique<TomlNode>());
      added.key = key->str();
      addKeyed(added, *key, *child);
    }
  }

  void addKeyed(TomlNode& node, const toml::key& key, const toml::node& source) {
    const toml::table* table = source.as_table();
    if (isArrayOfHeaders(source)) {
      node.kind = TomlNode::Kind::array;
      for (const toml::node& element : *source.as_array()) {
        addSection(*node.children.emplace_back(std::make_unique<TomlNode>()), *element.as_table());
      }
    } else if (table && !table->is_inline() && text_[offset(source.source().begin)] == '[') {
      isImplicit(*table) ? addChildren(node, *table) : addSection(node, *table);
    } else if (table && !table->is_inline()) {
      dotted_.push_back(&node);
      addChildren(node, *table);
      dotted_.pop_back();
    } else {
      addValue(node, source);
      addStatement(node, key, source);
    }
  }

  void addSection(TomlNode& node, const toml::table& table) {
    const TextRange header = linesOf(table.source());
    node.section = TomlSection{.begin = header.begin, .end = header.end};
    TomlSection* outer = std::exchange(section_, &*node.section);
    addChildren(node, table);
    section_ = outer;
  }

  void addValue(TomlNode& node, const toml::node& source) {
    node.value = range(source.source());
    node.kind = TomlNode::Kind::scalar;
    if (const toml::array* array = source.as_array()) {
      node.kind = TomlNode::Kind::array;
      for (const toml::node& element : *array) {
        addValue(*node.children.emplace_back(std::make_unique<TomlNode>()), element);
      }
    } else if (const toml::table* table = source.as_table()) {
      node.kind = TomlNode::Kind::table;
      TomlSection* outer = std::exchange(section_, nullptr);
      std::vector<TomlNode*> outerDotted = std::exchange(dotted_, {});
      addChildren(node, *table);
      section_ = outer;
      dotted_ = std::move(outerDotted);
      keyItems(node);
    }
  }

  // Keys in braces begin behind the brace or the comma.
  void keyItems(TomlNode& braces) {
    std::vector<TomlNode*> items = itemsOf(braces);
    std::ranges::sort(items, [](auto* a, auto* b) { return a->value->begin < b->value->begin; });
    size_t end = braces.value->begin + 1;
    for (TomlNode* item : items) {
      item->keyed = TextRange{text_.find_first_not_of(" \t,", end), item->value->end};
      end = item->value->end;
    }
  }

  // Adds the range of `key = value` on lines of its own.
  void addStatement(TomlNode& node, const toml::key& key, const toml::node& source) {
    if (!section_) {
      return;
    }
    const TextRange lines{linesOf(key.source()).begin, linesOf(source.source()).end};
    const size_t begin = text_.find_first_not_of(" \t", lines.begin);
    node.keyed = TextRange{begin, node.value->end};
    node.statement = lines;
    const size_t keyEnd = offset(key.source().end);
    const size_t equals = text_.find('=', keyEnd);
    section_->linedUp = section_->linedUp || equals > keyEnd + 1;
    if (!section_->lastStatement || section_->lastStatement->begin < lines.begin) {
      section_->end = lines.end;
      section_->lastStatement = lines;
      section_->keyWidth = equals - begin;
    }
    std::string prefix;
    for (TomlNode* owner : dotted_) {
      prefix += tomlKey(owner->key) + ".";
      if (!owner->dotted || owner->dotted->begin < lines.begin) {
        owner->dotted = lines;
        owner->dottedPrefix = prefix;
      }
    }
  }

  std::string text_;
  std::vector<size_t> lines_;       // where each begins
  TomlSection* section_ = nullptr;  // section whose statements are read; null in braces
  std::vector<TomlNode*> dotted_;   // tables around the current one that dotted keys have made
};

void moveBack(TomlNode& node, size_t bytes) {
  for (std::optional<TextRange>* range : {&node.value, &node.keyed}) {
    if (*range) {
      *range = TextRange{(*range)->begin - bytes, (*range)->end - bytes};
    }
  }
  for (const auto& child : node.children) {
    moveBack(*child, bytes);
  }
}

}  // namespace

TomlNode* TomlNode::child(std::string_view name) {
  const auto found = std::ranges::find_if(children, [&](const auto& c) { return c->key == name; });
  return kind == Kind::table && found != children.end() ? found->get() : nullptr;
}

const TomlNode* TomlNode::child(std::string_view name) const {
  return const_cast<TomlNode*>(this)->child(name);
}

std::vector<TomlNode*> itemsOf(const TomlNode& list) {
  std::vector<TomlNode*> items;
  for (const auto& child : list.children) {
    const std::vector<TomlNode*> own = child->value ? std::vector{child.get()} : itemsOf(*child);
    items.insert(items.end(), own.begin(), own.end());
  }
  return items;
}

TomlNode outlineOf(std::string_view text) {
  return Outliner(std::string(text)).file();
}

TomlNode outlineOfValue(std::string_view text) {
  const std::string key = "v = ";
  TomlNode node = Outliner(key + std::string(text)).value("v");
  moveBack(node, key.size());
  return node;
}

}  // namespace speculum
