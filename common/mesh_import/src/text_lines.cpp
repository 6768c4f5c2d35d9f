#include "text_lines.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "import_fault.hpp"
#include "mesh_import/import_mesh.hpp"

namespace pelagos {

namespace {

constexpr std::size_t kBlock = 1u << 16;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// Bytes of the character that a text begins with, as UTF-8 has it; 0 for control characters and broken ones.
std::size_t length_of_character(std::string_view text) {
  const auto byte = [&](std::size_t n) { return static_cast<unsigned>(static_cast<unsigned char>(text[n])); };
  const unsigned first = byte(0);
  if (first < 0x80u) return first < 0x20u || first == 0x7Fu ? 0 : 1;
  if (first < 0xC2u || first > 0xF4u) return 0;
  const std::size_t length = first < 0xE0u ? 2 : first < 0xF0u ? 3 : 4;
  if (text.size() < length) return 0;
  for (std::size_t n = 1; n < length; ++n)
    if ((byte(n) & 0xC0u) != 0x80u) return 0;
  if (first == 0xC2u && byte(1) < 0xA0u) return 0;                                           // C1 controls
  if ((first == 0xE0u && byte(1) < 0xA0u) || (first == 0xF0u && byte(1) < 0x90u)) return 0;  // longer than need be
  if ((first == 0xEDu && byte(1) >= 0xA0u) || (first == 0xF4u && byte(1) >= 0x90u)) return 0;
  return length;
}

}  // namespace

TextLines::TextLines(OpenFile& file, bool continued) : file_(file), continued_(continued), block_(kBlock) {
  if (!refill()) return;
  const std::string_view start(block_.data(), end_);
  if (start.starts_with("\xEF\xBB\xBF")) begin_ = 3;
  if (start.starts_with("\xFF\xFE") || start.starts_with("\xFE\xFF"))
    throw ImportFault("is text in UTF-16; allowed: UTF-8 or ASCII. Save it so");
}

bool TextLines::refill() {
  std::copy(block_.begin() + static_cast<std::ptrdiff_t>(begin_), block_.begin() + static_cast<std::ptrdiff_t>(end_),
            block_.begin());
  end_ -= begin_;
  begin_ = 0;
  if (end_ == block_.size()) block_.resize(2 * block_.size());
  const std::size_t count = file_.read(std::span(block_).subspan(end_));
  end_ += count;
  return count > 0;
}

bool TextLines::next_physical() {
  if (++physical_ > MeshLimits::kLines)
    throw ImportFault("more than " + std::to_string(MeshLimits::kLines) +
                      " lines; reduce the mesh, or save it in a binary format (.glb, binary .stl)");
  const auto ends = [](char c) { return c == '\n' || c == '\r' || c == '\0'; };
  std::size_t searched = 0;
  while (true) {
    if (after_return_ && begin_ < end_) {  // CR LF is one end
      if (block_[begin_] == '\n') ++begin_;
      after_return_ = false;
    }
    const auto first = block_.begin() + static_cast<std::ptrdiff_t>(begin_);
    const auto last = block_.begin() + static_cast<std::ptrdiff_t>(end_);
    const auto found = std::find_if(first + static_cast<std::ptrdiff_t>(searched), last, ends);
    const auto length = static_cast<std::size_t>(found - first);
    if (length > MeshLimits::kLine)
      throw ImportFault(physical_, "longer than " + std::to_string(MeshLimits::kLine) + " characters");
    if (found != last) {
      if (*found == '\0') throw ImportFault(physical_, "holds a zero byte, so this is no text");
      after_return_ = *found == '\r';
      line_ = std::string_view(block_.data() + begin_, length);
      begin_ += length + 1;
      return true;
    }
    searched = length;
    if (!refill()) {
      line_ = std::string_view(block_.data() + begin_, end_ - begin_);
      begin_ = end_;
      return !line_.empty();
    }
  }
}

bool TextLines::next() {
  joined_.clear();
  if (!next_physical()) return false;
  number_ = physical_;
  if (!continued_ || !line_.ends_with('\\')) return true;
  while (line_.ends_with('\\')) {
    joined_ += line_.substr(0, line_.size() - 1);
    joined_ += ' ';
    if (joined_.size() > MeshLimits::kLine)
      throw ImportFault(number_, "longer than " + std::to_string(MeshLimits::kLine) + " characters");
    if (!next_physical()) return true;
  }
  joined_ += line_;
  return true;
}

std::string_view next_word(std::string_view& text) {
  const auto* start = std::find_if_not(text.begin(), text.end(), is_blank);
  const auto* stop = std::find_if(start, text.end(), is_blank);
  const std::string_view word(start, static_cast<std::size_t>(stop - start));
  text = std::string_view(stop, static_cast<std::size_t>(text.end() - stop));
  return word;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return lower;
}

std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  if (word.empty() || word.starts_with('+')) return std::nullopt;
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return std::nullopt;
  // Out of range is either too large or nearer to zero than any number: 1e-400.
  if (error == std::errc::result_out_of_range && word.find("e-") == word.npos && word.find("E-") == word.npos)
    return std::nullopt;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

double read_number(std::string_view word, std::size_t line) {
  if (const auto number = number_of(word)) return *number;
  if (word.empty()) throw ImportFault(line, "a number is missing at its end");
  std::string pointed(word);
  std::replace(pointed.begin(), pointed.end(), ',', '.');
  if (pointed != word)
    throw ImportFault(
        line, in_quotes(word) + (number_of(pointed) ? " has a decimal comma; write a decimal point: " + shown(pointed)
                                                    : " has a comma; numbers have a decimal point and blanks between"));
  throw ImportFault(line, in_quotes(word) + " is not a finite number; allowed are such as 1, -0.5, 1e-3");
}

std::string shown(std::string_view word, std::size_t most) {
  std::string text;
  std::size_t at = 0;
  while (at < word.size()) {
    const std::size_t length = length_of_character(word.substr(at));
    if (text.size() + std::max<std::size_t>(length, 1) > most) return text + "...";
    text += length == 0 ? "?" : word.substr(at, length);
    at += std::max<std::size_t>(length, 1);
  }
  return text;
}

std::string in_quotes(std::string_view word) { return '"' + shown(word) + '"'; }

}  // namespace pelagos
