#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "file_bytes.hpp"

namespace pelagos {

/// The lines of a text file, whichever characters end them (LF, CR LF, CR), one at a time.
class TextLines {
 public:
  /// @param continued  whether a backslash at the end of a line joins the next to it
  /// Passes over a byte order mark. @throws ImportFault if the text is UTF-16
  TextLines(OpenFile& file, bool continued);

  /// Goes on to the next line; false at the end. @throws ImportFault if it is too long or holds a zero byte
  [[nodiscard]] bool next();
  [[nodiscard]] std::string_view text() const { return joined_.empty() ? line_ : std::string_view(joined_); }
  [[nodiscard]] std::size_t number() const { return number_; }  ///< of the line, from 1; of the first that is joined

 private:
  [[nodiscard]] bool next_physical();
  [[nodiscard]] bool refill();

  OpenFile& file_;
  bool continued_;
  std::vector<char> block_;
  std::size_t begin_ = 0, end_ = 0;  ///< of what the block still holds
  std::string_view line_;
  std::string joined_;
  std::size_t number_ = 0, physical_ = 0;
  bool after_return_ = false;
};

/// Cuts the next word off the text; empty at its end.
[[nodiscard]] std::string_view next_word(std::string_view& text);

/// The text without blanks at its ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

[[nodiscard]] std::string lower_case(std::string_view text);

/// A number as files write it: 1, +1., .5, 1.E+2. Nothing if the word is no such number or it is not finite.
[[nodiscard]] std::optional<double> number_of(std::string_view word);

/// The same. @throws ImportFault naming the line, the word and what is wrong with it
[[nodiscard]] double read_number(std::string_view word, std::size_t line);

/// A word of a file as a message may show it: at most `most` bytes, control characters and what is no UTF-8 as '?'.
[[nodiscard]] std::string shown(std::string_view word, std::size_t most = 64);

/// The same between quotes.
[[nodiscard]] std::string in_quotes(std::string_view word);

}  // namespace pelagos
