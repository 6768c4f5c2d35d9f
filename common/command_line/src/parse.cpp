#include "command_line/parse.hpp"

#include <algorithm>
#include <iostream>

#include "text/characters.hpp"
#include "text/decimal.hpp"
#include "text/nearest_name.hpp"

namespace pelagos {
namespace {

using Words = std::vector<std::string>;

// ---- what options take

std::string type_of(const CLI::Option& option) {
  const std::string name = option.get_type_name();
  return name.substr(0, name.find(':'));
}

/// Numbers in decimal: zeros in front go, what is no number is refused, unless a check of the option's own does that.
void hold_to_decimal(CLI::Option& option) {
  const std::string type = type_of(option);
  const bool checked = option.get_type_name() != type;
  NumberKind kind = NumberKind::kReal;
  if (type == "INT") kind = NumberKind::kWhole;
  if (type == "UINT") kind = NumberKind::kNotNegative;
  if (type != "INT" && type != "UINT" && type != "FLOAT") return;
  option.transform(CLI::Validator(
      [kind, checked](std::string& input) -> std::string {
        const std::string fault = fault_of_number(input, kind);
        if (fault.empty()) input = without_leading_zeros(input);
        if (fault.empty() || checked) return "";
        const char* allowed = kind == NumberKind::kReal    ? "a decimal number"
                              : kind == NumberKind::kWhole ? "a whole number"
                                                           : "a whole number from 0 on";
        return input.empty() ? std::string("is empty; allowed: ") + allowed
                             : "is " + input + " (" + fault + "); allowed: " + allowed;
      },
      ""));
}

void refuse_empty(CLI::Option& option) {
  if (type_of(option) == "TEXT")
    option.transform(CLI::Validator(
        [](std::string& input) { return input.empty() ? std::string("is empty; a value is needed") : std::string(); },
        ""));
}

void prepare(CLI::App& app) {
  for (CLI::Option* option : app.get_options()) {
    if (option->get_items_expected_max() == 0) continue;  // a flag
    hold_to_decimal(*option);
    refuse_empty(*option);
  }
  for (CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) prepare(*command);
}

// ---- words that nothing knows

Words names_of_options(const CLI::App& app) {
  Words names;
  for (const CLI::Option* option : app.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  return names;
}

Words names_of_commands(const CLI::App& app) {
  Words names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(command->get_name());
  return names;
}

std::string listed(const Words& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "" : ", ") + word;
  return list;
}

/// What stands behind dashes, also typographic ones: programs for writing make one of two.
std::string letters_of(const std::string& word) {
  std::size_t i = 0;
  while (i < word.size()) {
    const Character character = character_at(word, i);
    if (character.code != '-' && ascii_for(character.code) != "-") break;
    i += character.bytes;
  }
  return word.substr(i);
}

bool is_option(const std::string& word) {
  const std::string letters = letters_of(word);
  if (letters.empty() || letters.size() == word.size()) return false;
  return letters[0] != '.' && !(letters[0] >= '0' && letters[0] <= '9');
}

/// A character that is not ASCII in a word that nothing knows, told with what to write instead; empty without one.
std::string foreign_part(const std::string& word) {
  for (std::size_t i = 0; i < word.size(); i += character_at(word, i).bytes) {
    const Character character = character_at(word, i);
    if (character.code > 0x7E || !character.valid)
      return ": it has a " + describe_character(character) + "; " +
             (character.valid ? advice_for(character) : "allowed: ASCII");
  }
  return "";
}

/// Walks the words before CLI11 does: it would tell of a missing option first, and never name the misspelt one.
class WordCheck {
 public:
  explicit WordCheck(const CLI::App& app) : root_(app), command_(&app) {}

  /// What is wrong with the words; empty if nothing.
  std::string find_fault(const Words& words);
  /// The command in whose words it stands; the program itself before any.
  [[nodiscard]] const CLI::App& command() const { return *command_; }

 private:
  std::string look_at_option(const std::string& word);
  std::string look_at_word(const std::string& word);
  [[nodiscard]] std::string look_at_value(const std::string& word) const;
  [[nodiscard]] const CLI::Option* find_option(const std::string& name) const;

  const CLI::App& root_;
  const CLI::App* command_;      // whose words come
  const CLI::Option* option_{};  // that may take the next words
  int wanted_ = 0;               // words that it takes for certain
};

const CLI::Option* WordCheck::find_option(const std::string& name) const {
  const CLI::Option* found = command_->get_option_no_throw(name);
  return found == nullptr && command_->get_fallthrough() ? root_.get_option_no_throw(name) : found;
}

std::string WordCheck::look_at_option(const std::string& word) {
  const std::size_t equals = word.find('=');
  const std::string name = word.substr(0, equals);
  const bool is_long = name.starts_with("--");
  option_ = find_option(is_long ? name : name.substr(0, 2));
  wanted_ = 0;
  if (option_ == nullptr) {
    Words known = names_of_options(*command_);
    const Words general = names_of_options(root_);
    if (command_ != &root_ && command_->get_fallthrough()) known.insert(known.end(), general.begin(), general.end());
    const std::string letters = letters_of(name);
    const std::string nearest = letters.size() > 1 ? nearest_name("--" + letters, known) : "";
    const std::string where = command_ == &root_ ? "" : " of " + command_->get_name();
    return "unknown option " + name + where + foreign_part(name) +
           (nearest.empty() ? "; allowed: " + listed(known) : "; did you mean " + nearest + "?");
  }
  if (equals == std::string::npos) wanted_ = option_->get_items_expected_min();
  if (equals != std::string::npos && equals + 1 == word.size()) return name + ": is empty; a value is needed";
  return "";
}

std::string WordCheck::look_at_word(const std::string& word) {
  if (wanted_ > 0) {
    --wanted_;
    return "";
  }
  const Words commands = names_of_commands(*command_);
  if (commands.empty()) return "";  // CLI11 knows how many words a program or a command takes
  if (std::find(commands.begin(), commands.end(), word) != commands.end()) {
    command_ = command_->get_subcommand(word);
    return "";
  }
  const std::string nearest = nearest_name(word, commands);
  return "unknown command " + (word.empty() ? "\"\"" : word) + foreign_part(word) +
         (nearest.empty() ? "; allowed: " : "; did you mean " + nearest + "? Allowed: ") + listed(commands);
}

/// A word with a dash where a value is due: CLI11 would take it.
std::string WordCheck::look_at_value(const std::string& word) const {
  const std::string name = option_->get_name();
  if (word.starts_with("--")) return name + ": its value is missing before " + word;
  return name + ": is " + word + "; " +
         (type_of(*option_) == "TEXT" ? "write " + name + "=" + word + " if it is meant" : "allowed: a decimal number");
}

std::string WordCheck::find_fault(const Words& words) {
  for (const std::string& word : words) {
    if (word == "--") break;
    if (wanted_ > 0 && is_option(word)) return look_at_value(word);
    const std::string fault = is_option(word) ? look_at_option(word) : look_at_word(word);
    if (!fault.empty()) return fault;
  }
  return "";
}

// ---- what CLI11 finds

/// The option or positional word of that name, wherever it stands.
const CLI::Option* find_anywhere(const CLI::App& app, const std::string& name) {
  if (const CLI::Option* found = app.get_option_no_throw(name)) return found;
  for (const CLI::App* command : app.get_subcommands())
    if (const CLI::Option* found = find_anywhere(*command, name)) return found;
  return nullptr;
}

/// CLI11 says "NAME: 1 required TEXT missing" and "NAME: At Most 1 required but received 2".
std::string explain_count(const CLI::App& app, const std::string& message) {
  const CLI::Option* option = find_anywhere(app, message.substr(0, message.find(':')));
  if (option == nullptr) return message;
  const int least = option->get_items_expected_min(), most = option->get_items_expected_max();
  const int given = static_cast<int>(option->count());
  const std::string name = option->get_name();
  const auto are_given = [&] { return std::to_string(given) + (given == 1 ? " is given" : " are given"); };
  if (given < least && least == 1) return name + ": its value is missing";
  if (given < least) return name + ": needs " + std::to_string(least) + " values, " + are_given();
  if (given > most && most == 1) return name + ": is given " + std::to_string(given) + " times; allowed: once";
  return message;
}

std::string explain(const CLI::App& app, const CLI::ParseError& error) {
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {
    const Words words = app.remaining(true);
    if (!words.empty()) return "unexpected argument \"" + words.front() + "\"" + foreign_part(words.front());
  }
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) != nullptr) return explain_count(app, error.what());
  const bool required = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  if (required && std::string(error.what()).find("subcommand") != std::string::npos)
    return "a command is missing; allowed: " + listed(names_of_commands(app));
  return error.what();
}

/// The program or command whose help has more, e.g. "pelagos-ctl wind".
std::string help_of(const CLI::App& app, const CLI::App& command) {
  return &app == &command ? app.get_name() : app.get_name() + " " + command.get_name();
}

/// -.5 is a number, which CLI11 takes for an option.
std::string with_zero(const std::string& word) {
  return word.size() > 2 && word.starts_with("-.") ? "-0" + word.substr(1) : word;
}

/// Negative numbers are values by themselves: a "--" that only values follow says nothing, and CLI11 would hand these
/// from a command to the program.
void drop_needless_mark(Words& words) {
  const auto mark = std::find(words.begin(), words.end(), "--");
  if (mark != words.end() && std::none_of(mark + 1, words.end(), is_option)) words.erase(mark);
}

}  // namespace

std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv, std::ostream& out,
                                      std::ostream& err) {
  prepare(app);
  Words words;
  for (int i = 1; i < argc; ++i) words.push_back(with_zero(argv[i]));
  drop_needless_mark(words);
  WordCheck check(app);
  const auto fail = [&](const std::string& fault) {
    err << app.get_name() << ": " << fault << " (see " << help_of(app, check.command()) << " --help)\n";
    return 2;
  };
  if (const std::string fault = check.find_fault(words); !fault.empty()) return fail(fault);
  try {
    std::reverse(words.begin(), words.end());  // as CLI11 takes them
    app.parse(words);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error, out, err);
    return fail(explain(app, error));
  }
  return std::nullopt;
}

std::optional<int> parse_command_line(CLI::App& app, int argc, const char* const* argv) {
  return parse_command_line(app, argc, argv, std::cout, std::cerr);
}

}  // namespace pelagos
