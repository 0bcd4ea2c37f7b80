#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace speculum {

// Returns `text` without leading and trailing blanks.
std::string_view trimmed(std::string_view text);

// Returns a name without the comment behind it: without a '#' after a blank, or at the beginning, and what follows. It
// may be part of the name as well, so the whole name comes first wherever names are looked up.
std::string_view withoutComment(std::string_view name);

// Returns a text without the quotes around it.
std::string_view withoutQuotes(std::string_view text);

// Reads the whole of `token` as a number. Infinite and NaN values, written or from overflow, are numbers. Returns
// nothing for any other text.
std::optional<double> parseNumber(std::string_view token);

// Splits the text of an OBJ or MTL file into lines of tokens. Lines end with LF, CR LF or CR. A byte order mark,
// comments and lines without a token are skipped. The text must outlive the reader.
class LineReader {
 public:
  // A backslash at the end of a line, before any blanks, joins the next line to it, in OBJ but not in MTL files. It
  // does not if it is part of a name: of o, g or usemtl, or the second byte of a character of Shift-JIS or Big5.
  enum class Continuation { backslash, none };

  LineReader(std::string_view text, Continuation continuation);

  // Advances to the next line with a token; false at the end.
  bool next();

  const std::vector<std::string_view>& tokens() const { return tokens_; }
  std::string_view keyword() const { return tokens_[0]; }
  // Returns the rest of the line, with blanks within and with any comment.
  std::string_view from(std::string_view token) const { return trimmed(line_.substr(token.data() - line_.data())); }
  std::string_view after(std::string_view token) const { return from({token.data() + token.size(), 0}); }
  std::string_view argument() const { return after(keyword()); }
  int number() const { return number_; }  // from 1; the first of joined lines
  double done() const { return 1.0 - static_cast<double>(rest_.size()) / static_cast<double>(size_); }

 private:
  std::string_view takeLine();
  bool continues(std::string_view line) const;
  void joinContinuation();
  void split();

  std::string_view rest_;
  size_t size_;
  Continuation continuation_;
  std::string_view line_;
  std::string joined_;  // storage of a line_ that was joined
  std::vector<std::string_view> tokens_;
  int number_ = 1;
  int linesTaken_ = 0;  // lines that line_ joins
};

}  // namespace speculum
