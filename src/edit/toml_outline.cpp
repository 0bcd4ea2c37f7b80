#include "edit/toml_outline.hpp"

#include <toml++/toml.h>

#include <algorithm>
#include <stdexcept>

#include "scene/toml_depth.hpp"

namespace speculum {

namespace {

constexpr std::string_view kBlanks = " \t";

struct KeyPart {
  std::string name;
  size_t begin = 0;
};

struct Key {
  std::vector<KeyPart> parts;
  TextRange range;
};

TomlNode& childOf(TomlNode& table, const std::string& name, TomlNode::Kind kind) {
  if (TomlNode* known = table.child(name)) {
    return *known;
  }
  auto node = std::make_unique<TomlNode>();
  node->kind = kind;
  node->key = name;
  return *table.children.emplace_back(std::move(node));
}

// The table that a header or a dotted key goes through: of an array of tables the last.
TomlNode& tableIn(TomlNode& table, const std::string& name) {
  TomlNode& node = childOf(table, name, TomlNode::Kind::table);
  return node.kind == TomlNode::Kind::array ? *node.children.back() : node;
}

class Outliner {
 public:
  explicit Outliner(std::string_view text) : text_(text), at_(text.starts_with("\xef\xbb\xbf") ? 3 : 0) {}

  TomlNode file() {
    TomlNode root;
    root.sections.push_back({.begin = at_, .end = at_});
    TomlNode* table = &root;
    for (skipBetween(); at_ < text_.size(); skipBetween()) {
      if (text_[at_] == '[') {
        table = &header(root);
      } else {
        statement(*table);
      }
    }
    return root;
  }

  void value(TomlNode& node) {
    const size_t begin = at_;
    const char c = peek();
    if (c == '"' || c == '\'') {
      node.kind = TomlNode::Kind::scalar;
      at_ = endOfTomlString(text_, at_);
    } else if (c == '[') {
      array(node);
    } else if (c == '{') {
      braces(node);
    } else {
      node.kind = TomlNode::Kind::scalar;
      at_ = std::min(text_.find_first_of(" \t\r\n,]}#", at_), text_.size());
    }
    node.value = TextRange{begin, at_};
  }

 private:
  char peek() const {
    if (at_ >= text_.size()) {
      throw std::logic_error("the outline ran past the end of the text");
    }
    return text_[at_];
  }

  void skipBlanks() { at_ = std::min(text_.find_first_not_of(kBlanks, at_), text_.size()); }

  // Blanks, line breaks and comments.
  void skipBetween() {
    for (;;) {
      at_ = std::min(text_.find_first_not_of(" \t\r\n", at_), text_.size());
      if (at_ == text_.size() || text_[at_] != '#') {
        return;
      }
      at_ = std::min(text_.find('\n', at_), text_.size());
    }
  }

  size_t lineStart(size_t at) const {
    const size_t before = at == 0 ? std::string_view::npos : text_.rfind('\n', at - 1);
    return before == std::string_view::npos ? 0 : before + 1;
  }

  size_t lineEnd(size_t at) const {
    const size_t found = text_.find('\n', at);
    return found == std::string_view::npos ? text_.size() : found + 1;
  }

  std::string keyName() {
    const size_t begin = at_;
    if (peek() != '"' && peek() != '\'') {
      at_ = std::min(text_.find_first_of(" \t.=]", at_), text_.size());
      return std::string(text_.substr(begin, at_ - begin));
    }
    at_ = endOfTomlString(text_, at_);
    const toml::table parsed = toml::parse("key = " + std::string(text_.substr(begin, at_ - begin)));
    return parsed["key"].value<std::string>().value();
  }

  Key key() {
    Key key{.range = {at_, at_}};
    for (;;) {
      skipBlanks();
      const size_t begin = at_;
      key.parts.push_back({keyName(), begin});
      key.range.end = at_;
      skipBlanks();
      if (peek() != '.') {
        return key;
      }
      ++at_;
    }
  }

  TomlNode& header(TomlNode& root) {
    const bool element = text_.substr(at_, 2) == "[[";
    const TomlSection section{.begin = lineStart(at_), .end = lineEnd(at_)};
    at_ += element ? 2 : 1;
    const Key name = key();
    at_ = std::min(section.end, text_.size());
    TomlNode* table = &root;
    for (size_t i = 0; i + 1 < name.parts.size(); ++i) {
      table = &tableIn(*table, name.parts[i].name);
    }
    if (element) {
      TomlNode& list = childOf(*table, name.parts.back().name, TomlNode::Kind::array);
      table = list.children.emplace_back(std::make_unique<TomlNode>()).get();
    } else {
      table = &tableIn(*table, name.parts.back().name);
    }
    table->sections.push_back(section);
    return *table;
  }

  // `key = value`, in lines of its own or in braces.
  TomlNode& keyedValue(TomlNode& table, Key& name) {
    name = key();
    ++at_;
    skipBlanks();
    TomlNode* owner = &table;
    for (size_t i = 0; i + 1 < name.parts.size(); ++i) {
      owner = &tableIn(*owner, name.parts[i].name);
    }
    TomlNode& node = childOf(*owner, name.parts.back().name, TomlNode::Kind::scalar);
    value(node);
    node.keyed = TextRange{name.range.begin, at_};
    return node;
  }

  void statement(TomlNode& table) {
    const size_t begin = at_;
    Key name;
    TomlNode& node = keyedValue(table, name);
    const TextRange lines{lineStart(begin), lineEnd(at_)};
    node.statement = lines;
    TomlSection& section = table.sections.back();
    section.end = lines.end;
    section.lastStatement = lines;
    const size_t equals = text_.find('=', name.range.end);
    section.linedUp = section.linedUp || equals > name.range.end + 1;
    section.keyWidth = equals - begin;
    TomlNode* owner = &table;
    for (size_t i = 0; i + 1 < name.parts.size(); ++i) {
      owner = &tableIn(*owner, name.parts[i].name);
      owner->dotted = lines;
      owner->dottedPrefix = std::string(text_.substr(begin, name.parts[i + 1].begin - begin));
    }
    at_ = std::min(lines.end, text_.size());
  }

  void array(TomlNode& node) {
    node.kind = TomlNode::Kind::array;
    ++at_;
    for (skipBetween(); peek() != ']'; skipBetween()) {
      if (peek() == ',') {
        ++at_;
        continue;
      }
      value(*node.children.emplace_back(std::make_unique<TomlNode>()));
    }
    ++at_;
  }

  void braces(TomlNode& node) {
    node.kind = TomlNode::Kind::table;
    ++at_;
    for (skipBlanks(); peek() != '}'; skipBlanks()) {
      if (peek() == ',') {
        ++at_;
        continue;
      }
      Key name;
      keyedValue(node, name);
    }
    ++at_;
  }

  std::string_view text_;
  size_t at_ = 0;
};

}  // namespace

TomlNode* TomlNode::child(std::string_view name) {
  const auto found = std::find_if(children.begin(), children.end(), [&](const auto& c) { return c->key == name; });
  return kind == Kind::table && found != children.end() ? found->get() : nullptr;
}

const TomlNode* TomlNode::child(std::string_view name) const {
  return const_cast<TomlNode*>(this)->child(name);
}

TomlNode outlineOf(std::string_view text) {
  return Outliner(text).file();
}

TomlNode outlineOfValue(std::string_view text) {
  TomlNode node;
  Outliner(text).value(node);
  return node;
}

}  // namespace speculum
