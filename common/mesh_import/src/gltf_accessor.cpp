#include "gltf_accessor.hpp"

#include <algorithm>

#include "import_fault.hpp"
#include "mesh_builder.hpp"
#include "text_lines.hpp"

namespace pelagos {

using Json = nlohmann::json;

std::size_t GltfAccessor::size_of(std::size_t component, const std::string& where) {
  switch (component) {
    case kByte:
    case kUByte:
      return 1;
    case kShort:
    case kUShort:
      return 2;
    case kUInt:
    case kFloat:
      return 4;
    default:
      throw ImportFault(where + ".componentType is " + std::to_string(component) +
                        "; allowed: 5120 to 5123, 5125 and 5126");
  }
}

GltfAccessor::View GltfAccessor::view_of(GltfDocument& document, const Json& object, const std::string& where,
                                         std::size_t count, std::size_t components, std::size_t component) {
  const std::size_t size = components * size_of(component, where);
  const std::size_t number = whole_number(object, "bufferView", where);
  const Json& view = document.item("bufferViews", number);
  const std::string view_where = place_of("bufferViews", number);
  const auto buffer = document.buffer(whole_number(view, "buffer", view_where));
  const std::size_t start = whole_number(view, "byteOffset", view_where, 0);
  const std::size_t length = whole_number(view, "byteLength", view_where);
  const std::size_t stride = whole_number(view, "byteStride", view_where, size);
  const std::size_t offset = whole_number(object, "byteOffset", where, 0);
  if (start > buffer.size() || length > buffer.size() - start)
    throw ImportFault(view_where + " goes beyond its buffer of " + std::to_string(buffer.size()) + " bytes");
  if (stride < size) throw ImportFault(view_where + ".byteStride is less than an element of " + where);
  if (count > 0 && (offset > length || size > length - offset || (length - offset - size) / stride < count - 1))
    throw ImportFault(where + " has " + std::to_string(count) + " elements, which go beyond its view of " +
                      std::to_string(length) + " bytes");
  return {buffer.subspan(start, length).subspan(count > 0 ? offset : 0), stride, component};
}

GltfAccessor::GltfAccessor(GltfDocument& document, std::size_t index, const std::string& type) {
  const Json& accessor = document.item("accessors", index);
  const std::string where = place_of("accessors", index);
  const auto given = accessor.find("type");
  if (given == accessor.end() || *given != type)
    throw ImportFault(where + ".type is " + (given == accessor.end() ? "missing" : shown(given->dump())) +
                      "; needed here: " + type);
  components_ = type == "VEC3" ? 3 : 1;
  count_ = whole_number(accessor, "count", where);
  check_vertices(components_ == 3 ? count_ : 0);
  component_ = whole_number(accessor, "componentType", where);
  (void)size_of(component_, where);
  const auto normalized = accessor.find("normalized");
  normalized_ = normalized != accessor.end() && *normalized == true;
  const auto sparse = accessor.find("sparse");
  if (accessor.contains("bufferView"))
    base_ = view_of(document, accessor, where, count_, components_, component_);
  else if (sparse == accessor.end())
    throw ImportFault(where + ".bufferView is missing: it holds no numbers; save the mesh without compression");
  if (sparse != accessor.end()) read_sparse(document, *sparse, where + ".sparse");
}

void GltfAccessor::read_sparse(GltfDocument& document, const Json& sparse, const std::string& where) {
  if (!sparse.is_object() || !sparse.contains("indices") || !sparse["indices"].is_object() ||
      !sparse.contains("values") || !sparse["values"].is_object())
    throw ImportFault(where + " has no indices and values");
  const std::size_t count = whole_number(sparse, "count", where);
  if (count > count_) throw ImportFault(where + ".count is more than the accessor's");
  document.count_replaced(count);
  const Json& indices = sparse["indices"];
  const std::size_t component = whole_number(indices, "componentType", where + ".indices");
  const View view = view_of(document, indices, where + ".indices", count, 1, component);
  replaced_ = view_of(document, sparse["values"], where + ".values", count, components_, component_);
  for (std::size_t n = 0; n < count; ++n) {
    const double element = number_at(view, n, 0, false);
    if (!(element >= 0.0) || !(element < static_cast<double>(count_)) ||
        (n > 0 && !(element > static_cast<double>(replaced_elements_.back()))))
      throw ImportFault(where + ".indices must rise and stay below the accessor's count");
    replaced_elements_.push_back(static_cast<std::uint32_t>(element));
  }
}

double GltfAccessor::number_at(const View& view, std::size_t element, std::size_t part, bool normalized) {
  const std::size_t start = element * view.stride;
  const auto shared = [normalized](double value, double largest) {
    return normalized ? std::max(value / largest, -1.0) : value;
  };
  switch (view.component) {
    case kByte:
      return shared(static_cast<std::int8_t>(view.bytes[start + part]), 127.0);
    case kUByte:
      return shared(static_cast<std::uint8_t>(view.bytes[start + part]), 255.0);
    case kShort:
      return shared(static_cast<std::int16_t>(little_endian(view.bytes, start + 2 * part, 2)), 32767.0);
    case kUShort:
      return shared(little_endian(view.bytes, start + 2 * part, 2), 65535.0);
    case kUInt:
      return little_endian(view.bytes, start + 4 * part);
    default:
      return static_cast<double>(little_endian_float(view.bytes, start + 4 * part));
  }
}

std::pair<const GltfAccessor::View*, std::size_t> GltfAccessor::place(std::size_t element) const {
  const auto found = std::lower_bound(replaced_elements_.begin(), replaced_elements_.end(), element);
  if (found != replaced_elements_.end() && *found == element)
    return {&replaced_, static_cast<std::size_t>(found - replaced_elements_.begin())};
  return {&base_, element};
}

double GltfAccessor::number(std::size_t element, std::size_t component) const {
  const auto [view, at] = place(element);
  return view->bytes.empty() ? 0.0 : number_at(*view, at, component, normalized_);
}

std::uint32_t GltfAccessor::whole(std::size_t element) const { return static_cast<std::uint32_t>(number(element, 0)); }

}  // namespace pelagos
