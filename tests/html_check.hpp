#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// What is wrong with the tags of an HTML text: not nested, not closed, an attribute twice or without quotes. Text and
// the content of <script> and <style> are not looked at. Empty: nothing.
std::string htmlFault(std::string_view html);

struct HtmlElement {
  std::string name;
  std::vector<std::pair<std::string, std::string>> attributes;  // as written
  size_t begin = 0;                                             // of the tag in the text

  std::string attribute(std::string_view key) const;  // empty if there is none
};
// Start tags in order.
std::vector<HtmlElement> htmlElements(std::string_view html);

}  // namespace speculum
