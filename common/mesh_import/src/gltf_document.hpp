#pragma once

#include <deque>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "file_bytes.hpp"

namespace pelagos {

/// A glTF 2.0 file, text or binary: its JSON, bounded by MeshLimits, and its buffers, read when they are asked for.
class GltfDocument {
 public:
  using Json = nlohmann::json;

  /// @throws ImportFault if it is no glTF 2, is not whole, or requires an extension that is not read
  explicit GltfDocument(MeshFolder& folder);

  [[nodiscard]] const Json& root() const { return root_; }
  /// An object of one of the lists of the root, as "nodes". @throws ImportFault if there is none of this number
  [[nodiscard]] const Json& item(const char* list, std::size_t index) const;
  [[nodiscard]] std::size_t count(const char* list) const;
  [[nodiscard]] bool uses(const std::string& extension) const;
  /// The bytes of a buffer, as many as it says. @throws ImportFault if there are fewer
  [[nodiscard]] std::span<const char> buffer(std::size_t index);
  /// Counts elements of sparse accessors, which are read anew at each use. @throws ImportFault if they are too many
  void count_replaced(std::size_t elements);

 private:
  void read_text(std::string_view json);
  void read_binary();
  void check_version() const;
  void check_extensions() const;
  [[nodiscard]] std::span<const char> load(const Json& buffer, std::size_t index, const std::string& where);
  [[nodiscard]] std::span<const char> decoded(std::size_t data, const std::string& where);

  struct DataUri {
    std::span<char> bytes;  ///< within file_: the text after "data:", later what it stands for
    bool is_decoded = false;
  };

  MeshFolder& folder_;
  std::string file_;
  std::span<const char> binary_;  ///< chunk of a .glb
  std::vector<DataUri> data_;
  Json root_;
  std::size_t replaced_ = 0;
  std::vector<std::optional<std::span<const char>>> buffers_;
  std::deque<std::string> beside_;  ///< files that buffers lie in
};

/// An entry of an object that is a whole number from 0. @param where  of the object, as "accessors[3]"
/// @throws ImportFault naming it if it is something else, or missing without a fallback
[[nodiscard]] std::size_t whole_number(const nlohmann::json& object, const char* key, const std::string& where,
                                       std::optional<std::size_t> fallback = std::nullopt);
/// The same as an index into something, or nothing if it is missing.
[[nodiscard]] std::optional<std::size_t> index_of(const nlohmann::json& object, const char* key,
                                                  const std::string& where);
/// An entry that is a list, or an empty list if it is missing. @throws ImportFault if it is something else
[[nodiscard]] const nlohmann::json& list_of(const nlohmann::json& object, const char* key, const std::string& where);

/// "nodes[3]".
[[nodiscard]] std::string place_of(const char* list, std::size_t index);

}  // namespace pelagos
