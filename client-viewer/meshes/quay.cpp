#include "meshes/quay.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "meshes/coloured_parts.hpp"
#include "waves/splitmix.hpp"

namespace pelagos {
namespace {

constexpr double kLeastLength = 20.0, kLeastWidth = 2.0, kLeastHeight = 2.0;  // m
constexpr double kBlock = 6.0;                                                // m
constexpr int kMostBlocks = 60;                                               // a longer quay has longer ones
constexpr double kCoping = 0.5, kJoint = 0.07;                                // m
constexpr Colour kConcreteBlock = {0.36F, 0.35F, 0.32F}, kCopingStone = {0.45F, 0.44F, 0.41F},
                 kGap = {0.10F, 0.10F, 0.09F}, kDeck = {0.20F, 0.20F, 0.19F}, kRubber = {0.018F, 0.018F, 0.02F},
                 kIron = {0.04F, 0.04F, 0.045F}, kYellow = {0.62F, 0.42F, 0.03F};

Colour scaled(const Colour& colour, double by) {
  const auto share = static_cast<float>(by);
  return {share * colour[0], share * colour[1], share * colour[2]};
}

/// In axes along and across, its top at z = 0.
struct Quay {
  double half_length, half_width, height;  // m
  double block;                            // m, of one
  int blocks;
};

void add_blocks(const Quay& quay, ColouredParts& parts) {
  SplitMix64 random(17);
  parts.add_box({-quay.half_length + 0.1, -quay.half_width + 0.1, -quay.height},
                {quay.half_length - 0.1, quay.half_width - 0.1, -0.5 * kCoping}, kGap);
  for (int i = 0; i < quay.blocks; ++i) {
    const double from = -quay.half_length + i * quay.block, shade_of_it = 0.86 + 0.2 * random.next_unit();
    parts.add_box({from + 0.5 * kJoint, -quay.half_width, -quay.height},
                  {from + quay.block - 0.5 * kJoint, quay.half_width, -kCoping}, scaled(kConcreteBlock, shade_of_it));
    parts.add_box({from + 0.2 * kJoint, -quay.half_width, -kCoping + 0.06},
                  {from + quay.block - 0.2 * kJoint, quay.half_width, 0.0},
                  scaled(kCopingStone, 0.95 + 0.1 * random.next_unit()));
  }
}

void add_top(const Quay& quay, ColouredParts& parts) {
  const double edge = std::min(1.1, 0.35 * quay.half_width), line = edge - 0.12;
  parts.add_box({-quay.half_length + edge, -quay.half_width + edge, -0.2},
                {quay.half_length - edge, quay.half_width - edge, 0.03}, kDeck);
  for (const double side : {-1.0, 1.0}) {
    const double at = side * (quay.half_width - line);
    parts.add_box({-quay.half_length + line, at - 0.08, -0.1}, {quay.half_length - line, at + 0.08, 0.035}, kYellow);
  }
  const TriangleMesh post = make_mesh(CylinderShape{0.20, 0.55}), head = make_mesh(CylinderShape{0.30, 0.14});
  for (int i = 0; i < quay.blocks; i += 2)
    for (const double side : {-1.0, 1.0}) {
      const double along = -quay.half_length + (i + 0.5) * quay.block, across = side * (quay.half_width - 0.5);
      parts.add(post, {along, across, 0.27}, kIron);
      parts.add(head, {along, across, 0.55}, kYellow);
    }
}

void add_sides(const Quay& quay, ColouredParts& parts) {
  const double deep = std::min(3.4, quay.height - 0.1);
  for (const double side : {-1.0, 1.0}) {
    const auto box = [&](double along, double wide, double out, double from, double to, const Colour& colour) {
      const double inner = side * (quay.half_width - 0.05), outer = side * (quay.half_width + out);
      parts.add_box({along - 0.5 * wide, std::min(inner, outer), from},
                    {along + 0.5 * wide, std::max(inner, outer), to}, colour);
    };
    for (int i = 0; i < quay.blocks; ++i) {
      const double along = -quay.half_length + (i + 0.5) * quay.block;
      box(along, 0.55, 0.33, -deep, -0.55, kRubber);
      if (i % 4 != 1) continue;
      for (const double rail : {1.3, 1.75}) box(along + rail, 0.07, 0.12, -deep, 0.0, kYellow);
      for (double rung = -0.3; rung > -deep; rung -= 0.3) box(along + 1.525, 0.4, 0.10, rung, rung + 0.05, kIron);
    }
  }
}

}  // namespace

bool looks_like_quay(const BoxShape& box) {
  return std::max(box.size.x(), box.size.y()) >= kLeastLength && std::min(box.size.x(), box.size.y()) >= kLeastWidth &&
         box.size.z() >= kLeastHeight;
}

MeshData draw_quay(const BoxShape& box) {
  const bool along_y = box.size.y() > box.size.x();
  const double length = std::max(box.size.x(), box.size.y()), width = std::min(box.size.x(), box.size.y());
  const int blocks = std::clamp(static_cast<int>(std::lround(length / kBlock)), 1, kMostBlocks);
  const Quay quay{0.5 * length, 0.5 * width, box.size.z(), length / blocks, blocks};
  ColouredParts parts;
  add_blocks(quay, parts);
  add_top(quay, parts);
  add_sides(quay, parts);
  parts.move({0.0, 0.0, 0.5 * box.size.z()});
  if (along_y) parts.turn();
  return parts.done();
}

}  // namespace pelagos
