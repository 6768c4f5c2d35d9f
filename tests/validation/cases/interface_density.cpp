#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "../../support/places.hpp"
#include "harness.hpp"
#include "measures.hpp"
#include "physics/kernel.hpp"

namespace pelagos::validation {

namespace {

/// The kernel on a line: the same shape, its integral over the line 1 (in space it is 1 over space).
double weight(const CubicSpline& kernel, double distance) {
  const auto radius = static_cast<double>(kernel.support_radius);
  return static_cast<double>(kernel.value(static_cast<float>(distance))) * M_PI * radius * radius / 6.0;
}

struct Densities {
  double standard, number;
};

/// Paper, eq. 4 and 36, at particle `i` of a line of spacing 1.
Densities densities_at(const CubicSpline& kernel, const std::vector<double>& x, const std::vector<double>& rest,
                       std::size_t i) {
  Densities sums{0.0, 0.0};
  const int reach = 6;  // the line goes on with the same liquid beyond its ends
  for (int j = static_cast<int>(i) - reach; j <= static_cast<int>(i) + reach; ++j) {
    const auto there = static_cast<std::size_t>(std::clamp(j, 0, static_cast<int>(x.size()) - 1));
    const double w = weight(kernel, std::abs(static_cast<double>(j) - static_cast<double>(i)));
    sums.standard += rest[there] * w;
    sums.number += rest[i] * w;
  }
  return sums;
}

/// The rows of one support radius of the reference: x, rest density, standard sum, number density.
std::array<std::vector<double>, 4> read_line(double support) {
  const auto columns = read_columns(test::source_path("tests/validation/data/interface_density_1d.csv"), "cubic");
  std::array<std::vector<double>, 4> line;
  for (std::size_t row = 0; row < columns[0].size(); ++row)
    if (columns[0][row] == support)
      for (std::size_t k = 0; k < 4; ++k) line[k].push_back(columns[k + 1][row]);
  return line;
}

void run_support(Session& session, const Subject& subject, double support) {
  const auto [x, rest, standard, number] = read_line(support);
  const CubicSpline kernel(support);
  Series series = session.series(subject, "line", "x,rest,standard,number");
  double worst = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const Densities ours = densities_at(kernel, x, rest, i);
    series.add({x[i], rest[i], ours.standard, ours.number});
    worst = std::max({worst, std::abs(ours.standard - standard[i]), std::abs(ours.number - number[i])});
  }
  session.add(subject,
              {"largest deviation", worst / 1000.0, "of the water's density", "direct summation", at_most(1e-6, 1e-5)});
}

}  // namespace

void run_interface_density(Session& session) {
  for (const double support : {2.0, 3.0, 4.0}) {
    const Subject subject{"interface_density", fmt::format("support {:g} d", support), kDefaultSolver, 1.0};
    session.attempt(subject, [&] { run_support(session, subject, support); });
  }
}

}  // namespace pelagos::validation
