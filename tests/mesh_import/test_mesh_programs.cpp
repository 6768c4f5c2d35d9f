// What the programs make of mesh files: how long they take, how much memory, and whether they say the same.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cmath>
#include <sstream>

#include "mesh_files.hpp"
#include "places.hpp"

namespace pelagos {
namespace {

using ::testing::HasSubstr;

struct Ended {
  int exit_code = -1;  ///< -1: by a signal
  double processor_seconds = 0.0;
  long peak_kilobytes = 0;
  std::string output;
};

Ended run(std::vector<std::string> command, const std::filesystem::path& log) {
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    const rlimit processor{20, 20};  // seconds
    setrlimit(RLIMIT_CPU, &processor);
    const int file = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  int status = 0;
  rusage use{};
  wait4(child, &status, 0, &use);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  std::ostringstream text;
  text << std::ifstream(log).rdbuf();
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, seconds(use.ru_utime) + seconds(use.ru_stime), use.ru_maxrss,
          text.str()};
}

std::string program(const std::string& name) { return test::build_path("bin/" + name); }

const std::string kBox =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

std::string star(int corners, int faces) {
  std::ostringstream text;
  for (int n = 0; n < corners; ++n)
    text << "v " << (1 + n % 2) * std::cos(6.283185307 * n / corners) << ' '
         << (1 + n % 2) * std::sin(6.283185307 * n / corners) << " 0\n";
  for (int f = 0; f < faces; ++f) {
    text << 'f';
    for (int n = 1; n <= corners; ++n) text << ' ' << n;
    text << '\n';
  }
  return text.str();
}

std::string statements(const char* word, int count) {
  std::ostringstream text;
  text << kBox;
  for (int n = 0; n < count; ++n) text << word << n << "\nf 1 2 3\n";
  return text.str();
}

std::string nodes(int count, bool doubled) {
  std::ostringstream text;
  text << R"({"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[)";
  for (int n = 1; n <= count; ++n) text << "{\"children\":[" << n << (doubled ? "," + std::to_string(n) : "") << "]},";
  text << "{}]}";
  return text.str();
}

/// Loose triangles, as many as are read: the most that the checks have to do.
std::string soup() {
  std::string bytes(80, ' ');
  const auto count = static_cast<std::uint32_t>(MeshLimits::kTriangles);
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  std::uint32_t random = 1;
  for (std::uint32_t n = 0; n < count; ++n) {
    float numbers[12];
    for (float& number : numbers) {
      random = random * 1664525u + 1013904223u;
      number = static_cast<float>(random >> 8);
    }
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST(MeshPrograms, RefusalsTakeASecondAndAQuarterGigabyteAtMost) {
  const test::MeshFiles files;
  const std::pair<const char*, std::string> hostile[] = {
      {"lists.gltf", std::string(500'000, '[')},
      {"chain.gltf", nodes(20'000, false)},
      {"doubled.gltf", nodes(24, true)},
      {"polygon.obj", star(60'000, 1)},
      {"polygons.obj", star(4'000, 200)},
      {"objects.obj", statements("o a", 100'000)},
      {"groups.obj", statements("g a", 9'000)},
      {"materials.obj", statements("usemtl a", 20'000)},
      {"soup.stl", soup()},
  };
  for (const auto& [name, bytes] : hostile) {
    const Ended ended = run({program("pelagos-mesh"), files.write(name, bytes)}, files.folder() / "log");
    EXPECT_EQ(ended.exit_code, 1) << name << ": " << ended.output;
    EXPECT_THAT(ended.output, HasSubstr(name));
    EXPECT_LT(ended.processor_seconds, 2.0) << name << ": one on a free machine";
    EXPECT_LT(ended.peak_kilobytes, 256 << 10) << name;
  }
}

TEST(MeshPrograms, AShapeThatIsNoneIsToldFromAFile) {
  const test::MeshFiles files;
  const Ended mesh = run({program("pelagos-mesh"), "primitive:box:2x1"}, files.folder() / "log");
  EXPECT_EQ(mesh.exit_code, 1);
  EXPECT_THAT(mesh.output, HasSubstr("primitive:box:2x1: is no shape; allowed: primitive:box:LENGTHxBREADTHxHEIGHT"));
}

TEST(MeshPrograms, PelagosMeshSaysWhatARunSays) {
  const test::MeshFiles files;
  const std::string open = kBox.substr(0, kBox.rfind("f 4"));
  const std::string turned = kBox.substr(0, kBox.rfind("f 4")) + "f 8 5 1 4\n";
  const std::string inwards = std::string(kBox).replace(
      kBox.find("f 4 3 2 1"), std::string::npos, "f 1 2 3 4\nf 8 7 6 5\nf 5 6 2 1\nf 6 7 3 2\nf 7 8 4 3\nf 8 5 1 4\n");
  const std::pair<const char*, std::string> faulty[] = {
      {"comma.obj", "v 0,5 0 0\n"},
      {"open.obj", open},
      {"turned.obj", turned},
      {"inwards.obj", inwards},
      {"none.stl", "solid\n"},
      {"none.gltf", "{}"},
      {"far.obj", test::replaced(kBox, "v 0", "v 1e7")},
  };
  for (const auto& [name, bytes] : faulty) {
    const std::string path = files.write(name, bytes);
    const Ended mesh = run({program("pelagos-mesh"), path}, files.folder() / "log");
    EXPECT_EQ(mesh.exit_code, 1) << name;
    const auto scene = files.write("a.scene",
                                   "name: \"a\" particle_spacing: 0.25\n"
                                   "patch { min { x: 0 y: 0 z: 0 } max { x: 3 y: 3 z: 3 } }\n"
                                   "water { block { min { x: 0 y: 0 z: 0 } max { x: 3 y: 3 z: 1 } } }\n"
                                   "body { id: 1 mesh_file: \"" +
                                       path + "\" position { x: 1 y: 1 z: 1 } }\n");
    const Ended bench =
        run({program("pelagos-bench"), "run", "--scene", scene, "--seconds", "0.1"}, files.folder() / "log");
    EXPECT_NE(bench.exit_code, 0) << name;
    std::istringstream lines(mesh.output);
    int told = 0;
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("  " + path + ": ")) continue;
      ++told;
      EXPECT_THAT(bench.output, HasSubstr(line.substr(2))) << name;
    }
    EXPECT_GT(told, 0) << name << ": " << mesh.output;
  }
}

}  // namespace
}  // namespace pelagos
