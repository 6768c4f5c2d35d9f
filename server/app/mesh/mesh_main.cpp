#include <CLI/CLI.hpp>
#include <iostream>
#include <map>

#include "command_line/number_check.hpp"
#include "command_line/parse.hpp"
#include "mesh_report.hpp"
#include "version/version.hpp"

namespace pelagos {
namespace {

void add_options(CLI::App& app, std::string& file, MeshQuestions& questions, bool& open) {
  const std::map<std::string, MeshAxes> axes{{"x-forward-z-up", MeshAxes::kXForwardZUp},
                                             {"z-forward-y-up", MeshAxes::kZForwardYUp}};
  app.add_option("FILE", file, "Mesh (.obj, .stl, .gltf, .glb) or a shape as primitive:box:2x1x0.5")->required();
  app.add_option("--scale", questions.options.scale, "Metres per unit of the file (default: 1)")
      ->check(NumberFrom(0.001, 1000.0));
  app.add_option_function<std::string>(
         "--axes", [&questions, axes](const std::string& name) { questions.options.axes = axes.at(name); },
         "The file's axes (default: x-forward-z-up; most glTF files are z-forward-y-up)")
      ->check(OneOf({"x-forward-z-up", "z-forward-y-up"}));
  CLI::Option* one_sided = app.add_flag("--open", open, "One side of something larger, as a sea bed");
  CLI::Option* waterline =
      app.add_option("--waterline", questions.waterline, "z of the water, m: displacement and waterplane")
          ->check(NumberFrom(-1e6, 1e6))
          ->excludes(one_sided);
  app.add_option("--draft", questions.draft, "The same by the height of the water above the lowest point, m")
      ->check(NumberFrom(0.0, 1e6))
      ->excludes(waterline)
      ->excludes(one_sided);
  app.add_option("--density", questions.density, "Of the water, kg/m^3 (default: 1025)")
      ->check(NumberFrom(500.0, 2000.0));
  app.add_option("--spacing", questions.spacing, "Particle spacing, m: number of boundary samples")
      ->check(NumberFrom(0.001, 100.0));
  app.add_option("--inset", questions.inset, "Of the samples, spacings (default: 0.53 where faces are flat, else 0.61)")
      ->check(NumberFrom(0.0, 1.0));
}

}  // namespace
}  // namespace pelagos

int main(int argc, char** argv) {
  CLI::App app{
      "Whether a mesh can be a body, and what it weighs in water.\n"
      "Example: pelagos-mesh assets/meshes/tanker_hull.obj --waterline 0 --spacing 1",
      "pelagos-mesh"};
  app.set_version_flag("--version", std::string("pelagos-mesh ") + pelagos::kVersion);
  std::string file;
  pelagos::MeshQuestions questions;
  bool open = false;
  pelagos::add_options(app, file, questions, open);
  if (const auto status = pelagos::parse_command_line(app, argc, argv)) return *status;
  if (open) questions.options.kind = pelagos::MeshKind::kOpen;
  return pelagos::report_mesh(file, questions, std::cout) ? 0 : 1;
}
