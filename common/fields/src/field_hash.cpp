#include "fields/field_hash.hpp"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace pelagos {

struct ByteHash::State {
  XXH3_state_t xxh3;
};

ByteHash::ByteHash() : state_(std::make_unique<State>()) { XXH3_64bits_reset(&state_->xxh3); }
ByteHash::~ByteHash() = default;

void ByteHash::add(const void* data, std::size_t bytes) { XXH3_64bits_update(&state_->xxh3, data, bytes); }

std::uint64_t ByteHash::value() const { return XXH3_64bits_digest(&state_->xxh3); }

}  // namespace pelagos
