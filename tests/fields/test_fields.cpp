#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fields/field_bytes.hpp"
#include "fields/field_difference.hpp"
#include "fields/field_hash.hpp"

namespace pelagos {
namespace {

enum class Colour : std::uint8_t { kRed, kGreen };

struct Part {
  double mass = 0.0;
  std::optional<Eigen::Vector3d> place;
  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("mass", self.mass);
    visit("place", self.place);
  }
};

/// A field of every kind.
struct Everything {
  bool flag = false;
  std::int64_t number = 0;
  Colour colour = Colour::kRed;
  std::string text;
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Zero();
  Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
  std::vector<float> numbers;
  std::vector<Eigen::Vector3d> places;
  std::vector<Part> parts;
  std::map<std::string, Part> by_name;
  std::set<std::uint32_t> ids;
  std::array<std::optional<double>, 2> pair;
  std::variant<Part, double> either;
  std::size_t count = 0;
  std::vector<float> rows;
  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("flag", self.flag);
    visit("number", self.number);
    visit("colour", self.colour);
    visit("text", self.text);
    visit("matrix", self.matrix);
    visit("turn", self.turn);
    visit("numbers", self.numbers);
    visit("places", self.places);
    visit("parts", self.parts);
    visit("by_name", self.by_name);
    visit("ids", self.ids);
    visit("pair", self.pair);
    visit("either", self.either);
    visit("count", self.count);
    visit("rows", PaddedRows{self.rows, self.count, self.count + 2, -1.0F});
  }
};

Everything sample() {
  Everything e;
  e.flag = true;
  e.number = -7;
  e.colour = Colour::kGreen;
  e.text = "north";
  e.matrix(1, 2) = 4.5;
  e.turn = Eigen::Quaterniond(0.5, 0.5, -0.5, 0.5);
  e.numbers = {1.0F, 2.5F};
  e.places = {{1.0, 2.0, 3.0}, {4.0, 5.0, 6.0}};
  e.parts = {{3.0, std::nullopt}, {4.0, Eigen::Vector3d(1.0, 0.0, 0.0)}};
  e.by_name["a"] = {5.0, std::nullopt};
  e.ids = {9, 2};
  e.pair[1] = 0.25;
  e.either = 6.0;
  e.count = 3;
  e.rows = {1.0F, 2.0F, 3.0F, 77.0F};
  return e;
}

std::string field_of(const Everything& one, const Everything& other) {
  const auto difference = find_difference(one, other);
  return difference ? difference->field + ": " + difference->one + ", " + difference->other : "";
}

TEST(Fields, ComeBackFromBytes) {
  const Everything one = sample();
  Everything other;
  other.parts.resize(7);
  from_bytes(to_bytes(one), other);
  EXPECT_EQ(field_of(one, other), "");
  EXPECT_EQ(other.parts[1].place->x(), 1.0);
  EXPECT_EQ(other.ids, one.ids);
  EXPECT_THAT(other.rows, ::testing::ElementsAre(1.0F, 2.0F, 3.0F, -1.0F, -1.0F)) << "padding is made again";
  EXPECT_EQ(hash_fields(one), hash_fields(other)) << "padding is not hashed";
  EXPECT_EQ(to_bytes(one), to_bytes(other));
}

TEST(Fields, AreHashedAsTheirBytes) {
  const std::vector<std::byte> bytes = to_bytes(sample());
  ByteHash hash;
  hash.add(bytes.data(), bytes.size());
  EXPECT_EQ(hash_fields(sample()), hash.value());
}

TEST(Fields, NameTheFirstDifference) {
  const Everything one = sample();
  Everything other = sample();
  other.places[1].y() = 5.5;
  other.count = 2;
  EXPECT_EQ(field_of(one, other), "places[1].y: 5, 5.5");
  other = sample();
  other.parts[1].place->z() = -1.0;
  EXPECT_EQ(field_of(one, other), "parts[1].place.z: 0, -1");
  other = sample();
  other.text = "nerth";
  EXPECT_EQ(field_of(one, other), "text: \"north\", \"nerth\"");
  other = sample();
  other.by_name["b"] = {};
  EXPECT_EQ(field_of(one, other), "by_name.size: 1, 2");
  other = sample();
  other.rows[2] = 3.5F;
  EXPECT_EQ(field_of(one, other), "rows[2]: 3, 3.5");
  other = sample();
  other.matrix(1, 2) = 4.0;
  EXPECT_EQ(field_of(one, other), "matrix(7): 4.5, 4");
}

TEST(Fields, EveryChangeChangesTheHash) {
  const std::uint64_t base = hash_fields(sample());
  const auto hash_of = [](auto&& change) {
    Everything e = sample();
    change(e);
    return hash_fields(e);
  };
  EXPECT_EQ(hash_of([](Everything&) {}), base);
  EXPECT_NE(hash_of([](Everything& e) { e.flag = false; }), base);
  EXPECT_NE(hash_of([](Everything& e) { e.pair[0] = 0.0; }), base);
  EXPECT_NE(hash_of([](Everything& e) { e.either = Part{}; }), base);
  EXPECT_NE(hash_of([](Everything& e) { e.numbers[0] = -1.0F; }), base);
}

/// Bytes that end too early, anywhere, are refused, and so are bytes that are left over.
TEST(Fields, RefuseBytesOfAnotherLength) {
  const std::vector<std::byte> bytes = to_bytes(sample());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    Everything e;
    EXPECT_THROW(from_bytes(std::span(bytes).first(length), e), DecodeFault) << length;
  }
  std::vector<std::byte> more = bytes;
  more.push_back(std::byte{0});
  Everything e;
  EXPECT_THROW(from_bytes(more, e), DecodeFault);
}

/// A size that no file can hold allocates nothing.
TEST(Fields, RefuseSizesBeyondTheBytes) {
  Part part;
  part.place.emplace();
  std::vector<std::byte> bytes = to_bytes(std::vector<double>{1.0});
  bytes[6] = std::byte{0x10};
  std::vector<double> values;
  EXPECT_THROW(from_bytes(bytes, values), DecodeFault);
  std::optional<double> maybe;
  EXPECT_THROW(from_bytes(to_bytes(std::vector<double>{1.0, 2.0}), maybe), DecodeFault) << "2 of an optional";
}

/// As Part, but for one type.
struct OtherPart {
  float mass = 0.0F;
  std::optional<Eigen::Vector3d> place;
  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("mass", self.mass);
    visit("place", self.place);
  }
};

TEST(Fields, LayoutSeesNamesAndTypesAndNotValues) {
  EXPECT_EQ(layout_hash<Part>(), layout_hash<Part>());
  EXPECT_NE(layout_hash<Part>(), layout_hash<OtherPart>());
  EXPECT_NE(layout_hash<std::vector<Part>>(), layout_hash<std::optional<Part>>());
}

}  // namespace
}  // namespace pelagos
