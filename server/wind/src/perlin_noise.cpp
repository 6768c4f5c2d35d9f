#include "wind/perlin_noise.hpp"

#include <array>
#include <cmath>
#include <cstdint>

namespace pelagos {

namespace {

/// Perlin's permutation of 0..255.
constexpr std::array<std::uint8_t, 256> kPermutation{
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,  69,  142,
    8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,  94,  252, 219, 203,
    117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136, 171, 168, 68,  175, 74,  165,
    71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,
    55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,
    18,  169, 200, 196, 135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250,
    124, 123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189,
    28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,
    129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,
    242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114,
    67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

/// The twelve directions to the edges of a cube; four repeated, to make sixteen. In the order of the paper's text:
/// Perlin's Java listing exchanges 13 and 14, which gives another noise of the same statistics.
constexpr std::array<std::array<double, 3>, 16> kGradients{{{1, 1, 0},
                                                            {-1, 1, 0},
                                                            {1, -1, 0},
                                                            {-1, -1, 0},
                                                            {1, 0, 1},
                                                            {-1, 0, 1},
                                                            {1, 0, -1},
                                                            {-1, 0, -1},
                                                            {0, 1, 1},
                                                            {0, -1, 1},
                                                            {0, 1, -1},
                                                            {0, -1, -1},
                                                            {1, 1, 0},
                                                            {-1, 1, 0},
                                                            {0, -1, 1},
                                                            {0, -1, -1}}};

std::uint8_t permuted(unsigned value) { return kPermutation[value & 255u]; }

double fade(double s) { return s * s * s * (s * (s * 6.0 - 15.0) + 10.0); }

double mix(double s, double a, double b) { return a + s * (b - a); }

/// Lattice cell of a coordinate and the place within it. The cell is taken modulo 256 before it becomes an integer, so
/// that far coordinates cannot overflow.
struct CellPlace {
  unsigned cell;
  double offset;
};
CellPlace place(double value) {
  const double floor = std::floor(value);
  const double wrapped = floor - 256.0 * std::floor(floor / 256.0);
  return {static_cast<unsigned>(wrapped), value - floor};
}

}  // namespace

double perlin_noise(double x, double y, double z) {
  const CellPlace px = place(x), py = place(y), pz = place(z);
  // Contribution of the corner (i, j, k) of the cell: its hashed gradient times the way from the corner.
  const auto corner = [&](unsigned i, unsigned j, unsigned k) {
    const unsigned hash = permuted(permuted(permuted(px.cell + i) + py.cell + j) + pz.cell + k);
    const auto& gradient = kGradients[hash & 15u];
    return gradient[0] * (px.offset - i) + gradient[1] * (py.offset - j) + gradient[2] * (pz.offset - k);
  };
  const double u = fade(px.offset), v = fade(py.offset), w = fade(pz.offset);
  const double lower = mix(v, mix(u, corner(0, 0, 0), corner(1, 0, 0)), mix(u, corner(0, 1, 0), corner(1, 1, 0)));
  const double upper = mix(v, mix(u, corner(0, 0, 1), corner(1, 0, 1)), mix(u, corner(0, 1, 1), corner(1, 1, 1)));
  return mix(w, lower, upper);
}

}  // namespace pelagos
