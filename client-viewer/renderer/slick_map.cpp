#include "renderer/slick_map.hpp"

#include <algorithm>
#include <cmath>

#include "values/patch_frame.hpp"

namespace pelagos {
namespace {

/// Radius of an element's bell by that of its disc.
constexpr double kReachPerRadius = 1.0 / kDiscPerSize;
constexpr double kTexelsPerReach = 8.0;  // a bell so fine is smooth under linear interpolation
constexpr float kFringe = 2.5F;          // reaches, to where sheen goes out from free oil
constexpr float kHeldFringe = 1.3F;      // the same where a boom holds it, so that none shows beyond the boom
constexpr double kMostPixels = 16e6;     // of all discs together: the map is coarser where they cover each other more
constexpr int kRim = 2;                  // texels that stay empty on each side
constexpr float kMetresToMicrometres = 1e6F;

/// A disc as slick.vert reads it. Places and lengths in parts of the map.
struct DrawnDisc {
  float centre[2];
  float reach;      ///< radius of the bell
  float thickness;  ///< um
  float water;      ///< volume share
  float fringe;     ///< reaches, to where it is drawn
  float unused[2];
};
static_assert(sizeof(DrawnDisc) == 32);

double reach_of(const SlickDisc& disc) { return kReachPerRadius * static_cast<double>(disc.radius); }

/// Reach that nine of ten bells have at least, m.
double small_reach(std::span<const SlickDisc> discs) {
  std::vector<double> reaches;
  reaches.reserve(discs.size());
  for (const SlickDisc& disc : discs) reaches.push_back(reach_of(disc));
  const auto tenth = reaches.begin() + static_cast<std::ptrdiff_t>(reaches.size() / 10);
  std::nth_element(reaches.begin(), tenth, reaches.end());
  return *tenth;
}

/// The next length of the ladder, two rungs an octave.
double rung_above(double length) { return std::exp2(0.5 * std::ceil(2.0 * std::log2(length))); }

}  // namespace

SlickPlace place_of(const Slick& slick, int texels) {
  SlickPlace place;
  if (slick.discs.empty()) return place;
  Eigen::Array2d low = Eigen::Array2d::Constant(HUGE_VAL), high = -low, sum = Eigen::Array2d::Zero();
  double mass = 0.0, reach = 0.0, drawn_area = 0.0;
  for (const SlickDisc& disc : slick.discs) {
    const Eigen::Array2d at(disc.x, disc.y);
    low = low.min(at - static_cast<double>(kFringe) * reach_of(disc));
    high = high.max(at + static_cast<double>(kFringe) * reach_of(disc));
    const double weight = static_cast<double>(disc.mass) + 1e-9;  // kg; discs may have no mass at all
    sum += weight * at;
    mass += weight;
    reach += weight * reach_of(disc);
    drawn_area += std::pow(2.0 * static_cast<double>(kFringe) * reach_of(disc), 2);
  }
  const PatchFrame patch = PatchFrame::at(slick.origin);
  const double needed = (high - low).maxCoeff() / (texels - 2 * kRim - 1);
  const double affordable = std::sqrt(drawn_area / kMostPixels);
  const double texel = rung_above(std::max({needed, affordable, small_reach(slick.discs) / kTexelsPerReach}));
  place.corner = ((patch.to_world(Eigen::Vector2d(low.matrix())).array() / texel).floor() - kRim) * texel;
  place.length = texels * texel;
  place.centre = patch.to_world(Eigen::Vector2d((sum / mass).matrix()));
  place.reach = reach / mass;
  return place;
}

SlickMap::SlickMap(int texels)
    : program_("slick.vert", "slick.frag"),
      film_(texels, texels, GL_RGBA32F, GL_LINEAR, GL_CLAMP_TO_EDGE, 0),
      target_({&film_}) {}

void SlickMap::draw(const Slick& slick, const SlickPlace& place) {
  std::vector<DrawnDisc> drawn;
  drawn.reserve(slick.discs.size());
  const double smallest = place.length / film_.width();  // a bell of less than a texel could fall between them
  const PatchFrame patch = PatchFrame::at(slick.origin);
  for (const SlickDisc& disc : slick.discs) {
    const Eigen::Vector2d at = patch.to_world(Eigen::Vector2d(disc.x, disc.y)) - place.corner;
    const Eigen::Vector2f centre = (at / place.length).cast<float>();
    drawn.push_back({{centre.x(), centre.y()},
                     static_cast<float>(std::max(reach_of(disc), smallest) / place.length),
                     kMetresToMicrometres * disc.thickness,
                     disc.water,
                     disc.contained ? kHeldFringe : kFringe,
                     {}});
  }
  discs_.upload(drawn.data(), drawn.size() * sizeof(DrawnDisc));
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 0, discs_.id());
  target_.bind();
  const float nothing[4] = {0, 0, 0, 0};
  glClearNamedFramebufferfv(target_.id(), GL_COLOR, 0, nothing);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendEquationSeparate(GL_FUNC_ADD, GL_MAX);
  glBlendFunc(GL_ONE, GL_ONE);
  program_.use();
  program_.set("edge", static_cast<float>(kDiscPerSize));
  nothing_.bind();
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(drawn.size()));
  glDisable(GL_BLEND);
  glGenerateTextureMipmap(film_.id());
}

}  // namespace pelagos
