#pragma once

#include <cstddef>

// What the programs and the module that reads heights say to each other.

extern "C" {

struct PelagosHeightRequest {
  const char* file;
  double latitude_deg, longitude_deg;  // of the world's origin, WGS84
  const double* x;                     // m, world
  const double* y;
  std::size_t count;
  float* height;     // m; not a number where the file has none
  char* fault;       // what is wrong; empty: nothing
  std::size_t room;  // for it
};

using PelagosReadHeights = void (*)(const PelagosHeightRequest*);
}
