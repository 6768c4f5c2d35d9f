#include "gltf_document.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "import_fault.hpp"
#include "mesh_import/import_mesh.hpp"
#include "text_lines.hpp"

namespace pelagos {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMostJson = std::size_t{16} << 20;  ///< bytes, without the buffers inside
constexpr double kLargestWhole = 1e12;
constexpr std::string_view kData = "data:";

/// Extensions of materials, lights and the like change no triangle; quantized positions are read.
constexpr std::string_view kKnownExtensions[] = {"KHR_materials_",        "KHR_texture_",  "KHR_lights_",
                                                 "KHR_mesh_quantization", "KHR_xmp",       "EXT_texture_",
                                                 "EXT_lights_",           "MSFT_texture_", "KHR_animation_"};

void check_json(std::size_t bytes) {
  if (bytes > kMostJson)
    throw ImportFault("its JSON has more than " + std::to_string(kMostJson >> 20) + " MB besides its buffers");
}

/// The JSON without its data URIs: each is "data:#n" there, and the place of its text is kept. They are most of a file,
/// and the parser would copy them several times.
std::string take_data_uris(std::span<char> json, std::vector<std::span<char>>& data) {
  std::string rest;
  for (std::size_t at = 0; at < json.size();) {
    const char c = json[at++];
    rest += c;
    check_json(rest.size());
    if (c != '"') continue;
    const std::size_t start = at;
    while (at < json.size() && json[at] != '"') at += json[at] == '\\' ? 2 : 1;
    at = std::min(at, json.size());
    const auto text = json.subspan(start, at - start);
    if (std::string_view(text.data(), text.size()).starts_with(kData)) {
      if (data.size() > MeshLimits::kJsonValues) throw ImportFault("its JSON has too many data URIs");
      rest += std::string(kData) + '#' + std::to_string(data.size());
      data.push_back(text.subspan(kData.size()));
    } else {
      check_json(rest.size() + text.size());
      rest.append(text.data(), text.size());
    }
    if (at < json.size()) rest += json[at++];  // the closing quote
  }
  return rest;
}

std::string without_number(std::string_view what) {
  const std::size_t start = what.find("] ");  // after the parser's own number of the fault
  return shown(what.substr(start == what.npos ? 0 : start + 2), 200);
}

/// Counts what a parser finds and ends it where there is too much.
class JsonLimits : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return count(); }
  bool boolean(bool) override { return count(); }
  bool number_integer(number_integer_t) override { return count(); }
  bool number_unsigned(number_unsigned_t) override { return count(); }
  bool number_float(number_float_t, const string_t&) override { return count(); }
  bool string(string_t&) override { return count(); }
  bool binary(binary_t&) override { return count(); }
  bool key(string_t&) override { return count(); }
  bool start_object(std::size_t) override { return open(); }
  bool start_array(std::size_t) override { return open(); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error) override {
    throw ImportFault("is no JSON: " + without_number(error.what()));
  }

 private:
  bool count() {
    if (++values_ > MeshLimits::kJsonValues)
      throw ImportFault("its JSON has more than " + std::to_string(MeshLimits::kJsonValues) + " values");
    return true;
  }
  bool open() {
    if (++depth_ > MeshLimits::kJsonDepth)
      throw ImportFault("its JSON has more than " + std::to_string(MeshLimits::kJsonDepth) +
                        " brackets inside each other");
    return count();
  }
  bool close() {
    --depth_;
    return true;
  }

  std::size_t values_ = 0, depth_ = 0;
};

/// Parses twice: the first time to see that the limits hold, so that the second takes no more memory than they allow.
/// The parser itself does not recurse.
Json parse_bounded(const std::string& text) {
  JsonLimits limits;
  Json::sax_parse(text, &limits);
  return Json::parse(text);
}

int value_of_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

int value_of_hex(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// Decodes in place: what comes out is shorter. Returns its length, or nothing if the text is no base64.
std::optional<std::size_t> decode_base64(std::span<char> text) {
  std::size_t length = 0;
  std::uint32_t bits = 0;
  int held = 0;
  for (std::size_t n = 0; n < text.size(); ++n) {
    if (text[n] == '=') break;
    if (text[n] == '\\' && n + 1 < text.size() && text[n + 1] == '/') continue;  // JSON may write the slash so
    const int digit = value_of_digit(text[n]);
    if (digit < 0) return std::nullopt;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    held += 6;
    if (held < 8) continue;
    held -= 8;
    text[length++] = static_cast<char>(bits >> held & 0xFFu);
  }
  return length;
}

/// The same for %20 and its like.
std::size_t decode_percent(std::span<char> text) {
  std::size_t length = 0;
  for (std::size_t n = 0; n < text.size(); ++n) {
    const int high = text[n] == '%' && n + 2 < text.size() ? value_of_hex(text[n + 1]) : -1;
    const int low = high >= 0 ? value_of_hex(text[n + 2]) : -1;
    text[length++] = low >= 0 ? static_cast<char>(high * 16 + low) : text[n];
    if (low >= 0) n += 2;
  }
  return length;
}

/// "http" of "http://...", nothing for a relative path.
std::string scheme_of(const std::string& uri) {
  const std::size_t colon = uri.find(':');
  const bool is_scheme = colon != uri.npos && colon > 1 && uri.find('/') > colon &&
                         std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                                     [](char c) { return value_of_digit(c) >= 0 || c == '.'; });
  return is_scheme ? uri.substr(0, colon) : std::string();
}

}  // namespace

std::string place_of(const char* list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

std::optional<std::size_t> index_of(const Json& object, const char* key, const std::string& where) {
  const auto found = object.find(key);
  if (found == object.end()) return std::nullopt;
  const double value = found->is_number() ? found->get<double>() : -1.0;
  if (!(value >= 0.0) || value > kLargestWhole || value != std::floor(value))
    throw ImportFault(where + "." + key + " is " + shown(found->dump(-1, ' ', false, Json::error_handler_t::replace)) +
                      "; allowed: whole numbers from 0");
  return static_cast<std::size_t>(value);
}

std::size_t whole_number(const Json& object, const char* key, const std::string& where,
                         std::optional<std::size_t> fallback) {
  const auto given = index_of(object, key, where);
  if (!given && !fallback) throw ImportFault(where + "." + key + " is missing");
  return given ? *given : *fallback;
}

const Json& list_of(const Json& object, const char* key, const std::string& where) {
  static const Json kEmpty = Json::array();
  const auto found = object.find(key);
  if (found == object.end()) return kEmpty;
  if (!found->is_array()) throw ImportFault((where.empty() ? where : where + ".") + key + " is no list");
  return *found;
}

GltfDocument::GltfDocument(MeshFolder& folder) : folder_(folder), file_(read_all(folder, folder.mesh_file())) {
  if (file_.starts_with("glTF"))
    read_binary();
  else
    read_text(file_);
  check_version();
  check_extensions();
  buffers_.resize(count("buffers"));
}

void GltfDocument::read_text(std::string_view json) {
  if (json.starts_with("\xFF\xFE") || json.starts_with("\xFE\xFF"))
    throw ImportFault("is text in UTF-16; allowed: UTF-8. Save it so");
  std::vector<std::span<char>> data;
  const std::size_t start = static_cast<std::size_t>(json.data() - file_.data());
  const std::string rest = take_data_uris(std::span(file_).subspan(start, json.size()), data);
  for (const std::span<char> bytes : data) data_.push_back({bytes});
  root_ = parse_bounded(rest);
}

void GltfDocument::read_binary() {
  constexpr std::size_t kHeader = 12, kChunkHeader = 8;
  constexpr std::uint32_t kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;
  if (file_.size() < kHeader + kChunkHeader) throw ImportFault("is cut off: a .glb has at least 20 bytes");
  if (const std::uint32_t version = little_endian(file_, 4); version != 2)
    throw ImportFault("is binary glTF " + std::to_string(version) + "; allowed: glTF 2. Save it so");
  const std::size_t length = little_endian(file_, 8);
  if (length > file_.size())
    throw ImportFault("says that it has " + std::to_string(length) + " bytes, but has " + std::to_string(file_.size()) +
                      ": it is cut off. Save it again");
  std::optional<std::string_view> json;
  for (std::size_t at = kHeader; at + kChunkHeader <= length;) {
    const std::size_t size = little_endian(file_, at);
    const std::uint32_t kind = little_endian(file_, at + 4);
    at += kChunkHeader;
    if (size > length - at) throw ImportFault("is broken: a chunk is longer than the file");
    if (kind == kJsonChunk && !json) json = std::string_view(file_).substr(at, size);
    if (kind == kBinaryChunk && binary_.empty()) binary_ = std::span(file_).subspan(at, size);
    at += size;
  }
  if (!json) throw ImportFault("is broken: it has no JSON chunk");
  read_text(*json);
}

void GltfDocument::check_version() const {
  const Json version = root_.is_object() ? root_.value(Json::json_pointer("/asset/version"), Json()) : Json();
  if (!version.is_string()) throw ImportFault("is no glTF: asset.version is missing");
  const std::string text = version.get<std::string>();
  if (!text.starts_with("2.")) throw ImportFault("is glTF " + shown(text) + "; allowed: glTF 2. Save it so");
}

void GltfDocument::check_extensions() const {
  for (const Json& extension : list_of(root_, "extensionsRequired", "")) {
    const std::string name = extension.is_string() ? extension.get<std::string>() : extension.dump();
    const bool known = std::any_of(std::begin(kKnownExtensions), std::end(kKnownExtensions),
                                   [&](std::string_view prefix) { return name.starts_with(prefix); });
    if (!known)
      throw ImportFault("requires the extension " + shown(name) +
                        ", which is not read; save it without it (without compression, without instancing)");
  }
}

bool GltfDocument::uses(const std::string& extension) const {
  const Json& used = list_of(root_, "extensionsUsed", "");
  return std::find(used.begin(), used.end(), Json(extension)) != used.end();
}

const Json& GltfDocument::item(const char* list, std::size_t index) const {
  const Json& items = list_of(root_, list, "");
  if (index >= items.size())
    throw ImportFault("refers to " + place_of(list, index) + ", but has " + std::to_string(items.size()) + " " + list);
  if (!items[index].is_object()) throw ImportFault(place_of(list, index) + " is no object");
  return items[index];
}

void GltfDocument::count_replaced(std::size_t elements) {
  replaced_ += elements;
  if (replaced_ > MeshLimits::kVertices)
    throw ImportFault("its sparse accessors have more than " + std::to_string(MeshLimits::kVertices) +
                      " elements in all, counted once for each use");
}

std::size_t GltfDocument::count(const char* list) const { return list_of(root_, list, "").size(); }

std::span<const char> GltfDocument::buffer(std::size_t index) {
  const Json& object = item("buffers", index);
  std::optional<std::span<const char>>& loaded = buffers_[index];
  if (!loaded) {
    const std::string where = place_of("buffers", index);
    const std::size_t length = whole_number(object, "byteLength", where);
    const auto bytes = load(object, index, where);
    if (bytes.size() < length)
      throw ImportFault(where + ".byteLength is " + std::to_string(length) + ", but there are " +
                        std::to_string(bytes.size()) + " bytes");
    loaded = bytes.first(length);
  }
  return *loaded;
}

std::span<const char> GltfDocument::load(const Json& buffer, std::size_t index, const std::string& where) {
  const auto given = buffer.find("uri");
  if (given == buffer.end()) {
    if (index == 0 && !binary_.empty()) return binary_;
    throw ImportFault(where + ".uri is missing");
  }
  if (!given->is_string()) throw ImportFault(where + ".uri is no text");
  std::string uri = given->get<std::string>();
  if (uri.starts_with(kData)) {
    const auto number =
        uri.size() > kData.size() + 1 ? number_of(std::string_view(uri).substr(kData.size() + 1)) : std::nullopt;
    if (!number || !(*number >= 0.0) || !(*number < static_cast<double>(data_.size())))
      throw ImportFault(where + ".uri is no data URI that is read");
    return decoded(static_cast<std::size_t>(*number), where);
  }
  if (const std::string scheme = scheme_of(uri); !scheme.empty())
    throw ImportFault(where + ".uri is " + in_quotes(uri) + "; allowed: data URIs, and files beside the mesh");
  std::error_code error;
  if (const std::string as_written = uri;
      !std::filesystem::exists(folder_.mesh_file().parent_path() / as_written, error))
    uri.resize(decode_percent(uri));
  if (uri.find('\0') != uri.npos) throw ImportFault(where + ".uri has a zero byte");
  beside_.push_back(read_all(folder_, folder_.find(uri)));
  return beside_.back();
}

std::span<const char> GltfDocument::decoded(std::size_t data, const std::string& where) {
  DataUri& uri = data_[data];
  if (!uri.is_decoded) {
    const std::string_view text(uri.bytes.data(), uri.bytes.size());
    const std::size_t comma = text.find(',');
    if (comma == text.npos) throw ImportFault(where + ".uri is a data URI without a comma");
    const bool is_base64 = text.substr(0, comma).ends_with(";base64");
    uri.bytes = uri.bytes.subspan(comma + 1);
    const auto length = is_base64 ? decode_base64(uri.bytes) : std::optional(decode_percent(uri.bytes));
    if (!length) throw ImportFault(where + ".uri holds a character that is not base64");
    uri.bytes = uri.bytes.first(*length);
    uri.is_decoded = true;
  }
  return uri.bytes;
}

}  // namespace pelagos
