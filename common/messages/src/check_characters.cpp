#include "check_characters.hpp"

#include <vector>

#include "text/characters.hpp"

namespace pelagos {
namespace {

constexpr int kTabWidth = 8;  // as Protobuf counts columns

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_word(char c) { return is_letter(c) || is_digit(c); }
bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

/// A token of Protobuf's text format.
struct Token {
  enum class Kind { kNone, kWord, kNumber, kString, kSymbol, kEnd };
  Kind kind = Kind::kNone;
  std::size_t begin = 0, end = 0;  // in the text
  int line = 0;                    // from 0

  [[nodiscard]] bool is(Kind wanted) const { return kind == wanted; }
};
using Kind = Token::Kind;

/// Thrown and caught in this file alone: the first fault ends the walk.
struct BadText {
  TextRefusal fault;
};

class Walk {
 public:
  explicit Walk(std::string_view text) : text_(text), out_(text) {}

  /// The text with its numbers in decimal. Throws BadText.
  std::string run();

 private:
  [[nodiscard]] bool at_end() const { return at_ >= text_.size(); }
  [[nodiscard]] char peek(std::size_t ahead = 0) const {
    return at_ + ahead < text_.size() ? text_[at_ + ahead] : '\0';
  }
  [[nodiscard]] std::string text_of(const Token& token) const {
    return std::string(text_.substr(token.begin, token.end - token.begin));
  }
  [[nodiscard]] bool is_symbol(const Token& token, std::string_view any) const {
    return token.is(Kind::kSymbol) && any.find(text_[token.begin]) != std::string_view::npos;
  }
  [[nodiscard]] bool in_list() const { return !open_.empty() && text_[open_.back().begin] == '['; }
  /// A field's name with what it takes behind it.
  [[nodiscard]] bool starts_value(const Token& token) const { return is_symbol(token, ":{<["); }

  [[noreturn]] void refuse(std::size_t at, int line, const std::string& what) const;
  [[noreturn]] void refuse(const Token& token, const std::string& what) const { refuse(token.begin, token.line, what); }

  void step();  // over one byte, counting lines
  void check_line_end() const;
  void skip_blanks();
  Token next();
  void take_string();
  void take_number();
  void check_character() const;

  void look_at(const Token& token);
  void look_behind_number(const Token& token);
  void look_behind_name(const Token& token);
  void follow(const Token& token);

  std::string_view text_;
  std::string out_;
  std::size_t at_ = 0;
  int line_ = 0;
  Token before_, last_;  // the two tokens before the present one
  Token name_;           // the last name of a field
  std::vector<Token> open_;
};

void Walk::refuse(std::size_t at, int line, const std::string& what) const {
  const std::size_t newline = at == 0 ? std::string_view::npos : text_.rfind('\n', at - 1);
  int column = 0;
  for (std::size_t i = newline == std::string_view::npos ? 0 : newline + 1; i < at;) {
    column += text_[i] == '\t' ? kTabWidth - column % kTabWidth : 1;
    i += character_at(text_, i).bytes;
  }
  throw BadText{{line + 1, column + 1, name_.is(Kind::kWord) ? text_of(name_) : "", what}};
}

void Walk::step() {
  if (text_[at_] == '\n') ++line_;
  ++at_;
}

/// Protobuf ends a line at a line feed only: behind a lone carriage return, a comment would go on.
void Walk::check_line_end() const {
  if (peek() == '\0' && !at_end())
    refuse(at_, line_, "a zero byte stands here, which no text has; save the file as UTF-8 text");
  if (peek() != '\r') return;
  std::size_t end = at_;
  while (end < text_.size() && text_[end] == '\r') ++end;
  if (end < text_.size() && text_[end] != '\n')
    refuse(at_, line_,
           "a carriage return stands here without a line feed; save the file with line feeds (LF or CR LF)");
}

void Walk::skip_blanks() {
  bool comment = false;
  for (; !at_end() && (comment || is_blank(peek()) || peek() == '#'); step()) {
    check_line_end();
    if (peek() == '#') comment = true;
    if (peek() == '\n') comment = false;
  }
}

/// Strings may hold any character of UTF-8, but end on their line: one that does not was often closed typographically.
void Walk::take_string() {
  const char quote = peek();
  const int line = line_;
  std::size_t typographic = std::string_view::npos;
  step();
  while (!at_end() && peek() != quote && peek() != '\n') {
    const Character character = character_at(text_, at_);
    if (!character.valid)
      refuse(at_, line, "has a " + describe_character(character) + ", between quotes; " + advice_for(character));
    check_line_end();
    const std::string ascii = ascii_for(character.code);
    if (character.code > 0x7F && (ascii == "\"" || ascii == "'")) typographic = at_;
    if (peek() == '\\' && at_ + 1 < text_.size() && peek(1) != '\n') step();
    at_ += peek() == '\n' ? 0 : character_at(text_, at_).bytes;
  }
  if (!at_end() && peek() == quote) return step();
  if (typographic != std::string_view::npos)
    refuse(typographic, line,
           "has " + describe_character(character_at(text_, typographic)) + " where quotes end; write " + quote);
}

/// Digits, point, exponent, suffix f; or hexadecimal. Zeros in front become spaces, so that columns stay.
void Walk::take_number() {
  const std::size_t begin = at_;
  if (peek() == '0' && (peek(1) == 'x' || peek(1) == 'X')) {
    for (at_ += 2; is_word(peek());) ++at_;
    return;
  }
  while (is_digit(peek())) ++at_;
  if (peek() == '.') ++at_;
  while (is_digit(peek())) ++at_;
  if (peek() == 'e' || peek() == 'E') {
    const std::size_t sign = peek(1) == '-' || peek(1) == '+' ? 1 : 0;
    if (is_digit(peek(1 + sign)))
      for (at_ += 1 + sign; is_digit(peek());) ++at_;
  }
  if ((peek() == 'f' || peek() == 'F') && !is_word(peek(1))) ++at_;
  for (std::size_t i = begin; i + 1 < at_ && text_[i] == '0' && is_digit(text_[i + 1]); ++i) out_[i] = ' ';
}

/// Outside of quotes and comments Protobuf knows ASCII only.
void Walk::check_character() const {
  const Character character = character_at(text_, at_);
  if (character.valid && character.code >= 0x20 && character.code < 0x7F) return;
  refuse(at_, line_, describe_character(character) + " stands here; " + advice_for(character));
}

Token Walk::next() {
  skip_blanks();
  Token token{Kind::kEnd, at_, at_, line_};
  if (at_end()) return token;
  check_line_end();
  check_character();
  if (is_letter(peek())) {
    token.kind = Kind::kWord;
    while (is_word(peek())) ++at_;
  } else if (is_digit(peek()) || (peek() == '.' && is_digit(peek(1)))) {
    token.kind = Kind::kNumber;
    take_number();
  } else if (peek() == '"' || peek() == '\'') {
    token.kind = Kind::kString;
    if (last_.is(Kind::kNumber) && last_.end == at_)
      refuse(last_, "has " + std::string(1, peek()) + " behind the number " + text_of(last_) +
                        "; write the number alone, without separators");
    take_string();
  } else {
    token.kind = Kind::kSymbol;
    ++at_;
  }
  token.end = at_;
  return token;
}

/// A number is followed by the next field, or by what ends or separates.
void Walk::look_behind_number(const Token& token) {
  // NUMBER WORD, where the word is no name of a field: a unit. Known once the token behind the word is there.
  if (before_.is(Kind::kNumber) && last_.is(Kind::kWord) && !starts_value(token))
    refuse(before_, "has \"" + text_of(last_) + "\" behind the number " + text_of(before_) +
                        "; write the number alone, in the unit of the field");
  if (before_.is(Kind::kNumber) && is_symbol(last_, ",") && token.is(Kind::kNumber) && !in_list()) {
    const std::string whole = text_of(before_), part = text_of(token);
    std::string digits = whole;
    std::erase(digits, '.');  // as in 1.000,5, where they group thousands
    refuse(before_, "has a comma in the number " + whole + "," + part + "; write " + digits + "." + part +
                        (part.size() == 3 ? ", or " + digits + part + " if the comma groups thousands" : ""));
  }
  if (!last_.is(Kind::kNumber) || token.line != last_.line) return;
  if (token.is(Kind::kNumber))
    refuse(last_, "has two numbers, " + text_of(last_) + " and " + text_of(token) + "; write one, without spaces");
  if (token.is(Kind::kSymbol) && !is_symbol(token, ",;}>]{<["))
    refuse(last_, "has \"" + text_of(token) + "\" behind the number " + text_of(last_) + "; write the number alone");
}

/// A name without a value is told where it stands; Protobuf would blame the next line.
void Walk::look_behind_name(const Token& token) {
  const bool name = last_.is(Kind::kWord) && !is_symbol(before_, ":-") && !in_list();
  if (name && !starts_value(token) && token.line != last_.line)
    refuse(last_, "has no value; write " + text_of(last_) + ": VALUE or " + text_of(last_) + " { ... }");
  if (is_symbol(last_, ":") && token.line != last_.line && (token.is(Kind::kEnd) || is_symbol(token, "}>")))
    refuse(last_, "has no value behind the colon");
  // NAME : (new line) WORD : is the next field.
  if (is_symbol(before_, ":") && last_.is(Kind::kWord) && last_.line != before_.line && starts_value(token))
    refuse(before_, "has no value behind the colon");
}

void Walk::look_at(const Token& token) {
  look_behind_number(token);
  look_behind_name(token);
  if (starts_value(token) && last_.is(Kind::kWord)) name_ = last_;
}

void Walk::follow(const Token& token) {
  if (is_symbol(token, "{<[")) open_.push_back(token);
  if (is_symbol(token, "}>]") && !open_.empty()) open_.pop_back();
  before_ = last_;
  last_ = token;
}

std::string Walk::run() {
  if (const std::string encoding = foreign_encoding(text_); !encoding.empty())
    refuse(0, 0, "the text is encoded as " + encoding + "; save it as UTF-8");
  while (!last_.is(Kind::kEnd)) {
    const Token token = next();
    look_at(token);
    follow(token);
  }
  if (open_.empty()) return std::move(out_);
  name_ = {};
  refuse(open_.back(), "\"" + text_of(open_.back()) + "\" is opened here and never closed");
}

}  // namespace

CheckedText check_characters(std::string_view text) {
  try {
    return {Walk(without_byte_order_mark(text)).run(), std::nullopt};
  } catch (const BadText& bad) {
    return {"", bad.fault};
  }
}

}  // namespace pelagos
