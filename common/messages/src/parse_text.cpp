#include "messages/parse_text.hpp"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/io/tokenizer.h>
#include <google/protobuf/io/zero_copy_stream_impl_lite.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <utility>

#include "check_characters.hpp"

namespace pelagos {
namespace {

using google::protobuf::Descriptor;
using google::protobuf::FieldDescriptor;
using google::protobuf::FileDescriptor;
using google::protobuf::io::ArrayInputStream;
using google::protobuf::io::Tokenizer;

constexpr int kDeepestNesting = 16;  // a scene needs 5; bounds the parser's recursion

/// Keeps the first error, and the place of every field that the schema does not know.
class Collector : public google::protobuf::io::ErrorCollector {
 public:
  struct Place {
    int line;
    int column;
    bool operator<(const Place& other) const { return line != other.line ? line < other.line : column < other.column; }
  };
  void AddError(int line, google::protobuf::io::ColumnNumber column, const std::string& message) override {
    if (!error) error = TextRefusal{line + 1, column + 1, {"", message}};
  }
  /// The parser warns of an unknown field at the token that follows the field's name, quoting the name last.
  void AddWarning(int line, google::protobuf::io::ColumnNumber column, const std::string& message) override {
    const std::size_t last = message.rfind('"');
    const std::size_t first = last == std::string::npos || last == 0 ? std::string::npos : message.rfind('"', last - 1);
    if (first != std::string::npos) unknown[{line, column}] = message.substr(first + 1, last - first - 1);
  }
  std::optional<TextRefusal> error;
  std::map<Place, std::string> unknown;
};

class IgnoreErrors : public google::protobuf::io::ErrorCollector {
 public:
  void AddError(int, google::protobuf::io::ColumnNumber, const std::string&) override {}
};

/// Walks the tokens of a text once, keeping track of which message each stands in.
class NestingScan {
 public:
  NestingScan(std::string_view text, const Descriptor* message)
      : stream_(text.data(), static_cast<int>(text.size())), tokenizer_(&stream_, &ignore_) {
    tokenizer_.set_comment_style(Tokenizer::SH_COMMENT_STYLE);
    tokenizer_.set_allow_f_after_float(true);
    tokenizer_.set_require_space_after_number(false);
    levels_.push_back({"", message, {}, ""});
  }

  bool next() { return tokenizer_.Next(); }
  [[nodiscard]] const Tokenizer::Token& token() { return tokenizer_.current(); }
  [[nodiscard]] std::size_t depth() const { return levels_.size() + static_cast<std::size_t>(open_lists_); }
  [[nodiscard]] const std::string& path() const { return levels_.back().path; }
  [[nodiscard]] const Descriptor* message() const { return levels_.back().message; }
  /// Whether a real number is due; whole numbers may be hexadecimal, as seeds often are.
  [[nodiscard]] bool wants_real() const {
    const FieldDescriptor* field = message() == nullptr ? nullptr : message()->FindFieldByName(name_);
    return field != nullptr && (field->cpp_type() == FieldDescriptor::CPPTYPE_DOUBLE ||
                                field->cpp_type() == FieldDescriptor::CPPTYPE_FLOAT);
  }
  /// Whose value the present token is part of.
  [[nodiscard]] std::string field() const { return path().empty() ? name_ : path() + "." + name_; }

  /// Steps into or out of a message at the present token.
  void follow() {
    const std::string& text = token().text;
    if (token().type == Tokenizer::TYPE_IDENTIFIER) {
      name_ = text;
    } else if (text == "[") {
      levels_.back().list = name_;
      ++open_lists_;
    } else if (text == "]") {
      levels_.back().list.clear();
      if (open_lists_ > 0) --open_lists_;
    } else if (text == "{" || text == "<") {
      enter(levels_.back().list.empty() ? name_ : levels_.back().list);
    } else if ((text == "}" || text == ">") && levels_.size() > 1) {
      levels_.pop_back();
    }
  }

 private:
  struct Level {
    std::string path;
    const Descriptor* message;         // nullptr inside an unknown field
    std::map<std::string, int> count;  // entries of each repeated field so far
    std::string list;                  // name of the field whose [ ] is open
  };

  void enter(const std::string& name) {
    Level& here = levels_.back();
    const FieldDescriptor* field = here.message == nullptr ? nullptr : here.message->FindFieldByName(name);
    std::string path = here.path.empty() ? name : here.path + "." + name;
    if (field != nullptr && field->is_repeated()) path += "[" + std::to_string(here.count[name]++) + "]";
    const Descriptor* inner = field == nullptr ? nullptr : field->message_type();
    levels_.push_back({std::move(path), inner, {}, ""});
  }

  IgnoreErrors ignore_;
  ArrayInputStream stream_;
  Tokenizer tokenizer_;
  std::vector<Level> levels_;
  std::string name_;
  int open_lists_ = 0;
};

bool is_hexadecimal(const Tokenizer::Token& token) {
  return token.type == Tokenizer::TYPE_INTEGER && (token.text.starts_with("0x") || token.text.starts_with("0X"));
}

/// What the parser would end in a stack overflow, or refuse without naming the field.
std::optional<TextRefusal> check_tokens(std::string_view text, const Descriptor* message) {
  NestingScan scan(text, message);
  while (scan.next()) {
    if (scan.depth() > kDeepestNesting) {
      return TextRefusal{scan.token().line + 1,
                         scan.token().column + 1,
                         {"", "messages nested too deeply; allowed: " + std::to_string(kDeepestNesting) + " levels"}};
    }
    if (is_hexadecimal(scan.token()) && scan.wants_real())
      return TextRefusal{scan.token().line + 1,
                         scan.token().column + 1,
                         {scan.field(), "is " + scan.token().text + " (hexadecimal); allowed: a decimal number"}};
    scan.follow();
  }
  return std::nullopt;
}

/// Fields of scenes by the names that they had before, and their present ones.
constexpr std::array<std::pair<const char*, const char*>, 2> kRenamed{
    {{"tank", "patch"}, {"tank_edges", "patch_edges"}}};

std::string describe_unknown(const std::string& name, const Descriptor* message) {
  for (const auto& [before, now] : kRenamed)
    if (name == before && message != nullptr && message->FindFieldByName(now) != nullptr)
      return std::string("unknown field; its name is \"") + now + "\" now";
  std::vector<std::string> known;
  std::string list;
  for (int i = 0; message != nullptr && i < message->field_count(); ++i) {
    known.push_back(message->field(i)->name());
    list += (i == 0 ? "" : ", ") + message->field(i)->name();
  }
  const std::string nearest = nearest_name(name, known);
  return nearest.empty() ? "unknown field; allowed here: " + list
                         : "unknown field; did you mean \"" + nearest + "\"? allowed here: " + list;
}

TextRefusals place_unknown_fields(std::string_view text, const Descriptor* message,
                                  const std::map<Collector::Place, std::string>& unknown) {
  TextRefusals faults;
  NestingScan scan(text, message);
  bool more = true;
  while (more) {
    more = scan.next();  // the last token, at the end of the text, may follow a name too
    const auto found = unknown.find({scan.token().line, scan.token().column});
    if (found != unknown.end()) {
      const std::string& name = found->second;
      faults.push_back(
          {scan.token().line + 1,
           0,
           {scan.path().empty() ? name : scan.path() + "." + name, describe_unknown(name, scan.message())}});
    }
    if (more) scan.follow();
  }
  return faults;
}

std::string upper_case(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// Adds the values of every enum field of that name in a file and in those that it imports.
void collect_values(const FileDescriptor& file, const std::string& field_name, std::vector<std::string>& values) {
  for (int m = 0; m < file.message_type_count(); ++m) {
    const auto* field = file.message_type(m)->FindFieldByName(field_name);
    if (field == nullptr || field->enum_type() == nullptr) continue;
    for (int v = 1; v < field->enum_type()->value_count(); ++v) values.push_back(field->enum_type()->value(v)->name());
  }
  for (int i = 0; i < file.dependency_count(); ++i)
    if (values.empty()) collect_values(*file.dependency(i), field_name, values);
}

/// The parser names the enum's field but not what it may hold.
std::string explain(const std::string& message, const FileDescriptor& file) {
  if (message.rfind("Unknown enumeration value", 0) != 0) return message;
  const std::size_t last = message.rfind('"');
  const std::size_t first = message.rfind('"', last - 1);
  const std::string name = message.substr(first + 1, last - first - 1);
  const std::size_t begin = message.find('"'), end = message.find('"', begin + 1);
  const std::string given = upper_case(message.substr(begin + 1, end - begin - 1));
  std::vector<std::string> known;
  collect_values(file, name, known);
  if (known.empty()) return message;
  std::string list;
  for (const std::string& value : known) list += (list.empty() ? "" : ", ") + value;
  const std::string nearest = nearest_name(given, known);
  return message + (nearest.empty() ? "" : " Did you mean " + nearest + "?") + " Allowed: " + list + ".";
}

}  // namespace

void parse_text(std::string_view original, google::protobuf::Message& message, ParsedText& out) {
  const Descriptor* descriptor = message.GetDescriptor();
  if (const auto too_deep = check_tokens(original, descriptor)) {
    out.readable = false;
    out.faults = {*too_deep};
    return;
  }
  const CheckedText checked = check_characters(original);
  if (checked.fault) {
    out.readable = false;
    out.faults = {*checked.fault};
    return;
  }
  const std::string_view text = checked.text;
  Collector collector;
  google::protobuf::TextFormat::Parser parser;
  parser.RecordErrorsTo(&collector);
  parser.WriteLocationsTo(&out.locations);
  parser.AllowUnknownField(true);
  parser.SetRecursionLimit(kDeepestNesting);
  ArrayInputStream stream(text.data(), static_cast<int>(text.size()));
  if (!parser.Parse(&stream, &message) || collector.error) {
    out.readable = false;
    TextRefusal fault = collector.error.value_or(TextRefusal{1, 1, {"", "not a message in Protobuf text format"}});
    fault.refusal.what = explain(fault.refusal.what, *descriptor->file());
    out.faults = {fault};
    return;
  }
  out.faults = place_unknown_fields(text, descriptor, collector.unknown);
}

}  // namespace pelagos
