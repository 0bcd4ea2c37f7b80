#include "html_check.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <set>

namespace speculum {

namespace {

struct Tag {
  HtmlElement element;
  bool closing = false;
  bool selfClosing = false;
  std::string fault;
};

constexpr std::string_view space = " \t\n";

bool isVoid(std::string_view name) {
  constexpr std::array<std::string_view, 5> names = {"meta", "img", "input", "br", "link"};
  return std::find(names.begin(), names.end(), name) != names.end();
}

// `text` is what stands between < and >.
Tag parseTag(std::string_view text) {
  Tag tag;
  tag.closing = text.starts_with('/');
  tag.selfClosing = text.ends_with('/');
  text = text.substr(tag.closing ? 1 : 0, text.size() - (tag.closing ? 1 : 0) - (tag.selfClosing ? 1 : 0));
  size_t at = std::min(text.find_first_of(space), text.size());
  tag.element.name = text.substr(0, at);
  std::set<std::string> seen;
  while ((at = text.find_first_not_of(space, at)) < text.size()) {
    const size_t end = std::min(text.find_first_of(" \t\n=", at), text.size());
    const std::string key(text.substr(at, end - at));
    std::string value;
    at = end;
    if (end < text.size() && text[end] == '=') {
      const size_t quote = end + 1;
      const size_t close = quote < text.size() && text[quote] == '"' ? text.find('"', quote + 1) : std::string::npos;
      if (close == std::string::npos) {
        tag.fault = "attribute " + key + " has no quotes";
        return tag;
      }
      value = text.substr(quote + 1, close - quote - 1);
      at = close + 1;
    }
    if (!seen.insert(key).second) {
      tag.fault = "attribute " + key + " twice";
    }
    tag.element.attributes.emplace_back(key, value);
  }
  return tag;
}

size_t tagEnd(std::string_view html, size_t begin) {
  bool quoted = false;
  for (size_t i = begin; i < html.size(); ++i) {
    quoted ^= html[i] == '"';
    if (html[i] == '>' && !quoted) {
      return i;
    }
  }
  return std::string::npos;
}

// Calls `visit` for every tag; stops at the first fault, which it returns.
std::string forEachTag(std::string_view html, const std::function<std::string(Tag&)>& visit) {
  for (size_t at = html.find('<'); at != std::string::npos; at = html.find('<', at)) {
    if (html.substr(at).starts_with("<!DOCTYPE")) {
      ++at;
      continue;
    }
    const size_t end = tagEnd(html, at);
    if (end == std::string::npos) {
      return "a tag without end: " + std::string(html.substr(at, 60));
    }
    Tag tag = parseTag(html.substr(at + 1, end - at - 1));
    tag.element.begin = at;
    const std::string fault = tag.fault.empty() ? visit(tag) : tag.fault;
    if (!fault.empty()) {
      return fault + " at " + std::string(html.substr(at, 60));
    }
    at = end;
    if (!tag.closing && (tag.element.name == "script" || tag.element.name == "style")) {
      at = html.find("</" + tag.element.name, end);
    }
  }
  return {};
}

}  // namespace

std::string htmlFault(std::string_view html) {
  std::vector<std::string> open;
  std::string fault = forEachTag(html, [&](Tag& tag) -> std::string {
    if (tag.element.name.empty()) {
      return "a tag without name";
    }
    if (isVoid(tag.element.name) || tag.selfClosing) {
      return {};
    }
    if (!tag.closing) {
      open.push_back(tag.element.name);
      return {};
    }
    if (open.empty() || open.back() != tag.element.name) {
      return "</" + tag.element.name + "> closes " + (open.empty() ? "nothing" : "<" + open.back() + ">");
    }
    open.pop_back();
    return {};
  });
  return !fault.empty() ? fault : open.empty() ? "" : "<" + open.back() + "> is not closed";
}

std::string HtmlElement::attribute(std::string_view key) const {
  const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const auto& a) { return a.first == key; });
  return found == attributes.end() ? std::string() : found->second;
}

std::vector<HtmlElement> htmlElements(std::string_view html) {
  std::vector<HtmlElement> elements;
  forEachTag(html, [&](Tag& tag) -> std::string {
    if (!tag.closing) {
      elements.push_back(std::move(tag.element));
    }
    return {};
  });
  return elements;
}

}  // namespace speculum
