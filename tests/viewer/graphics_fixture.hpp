#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "renderer/gl_context.hpp"
#include "renderer/gl_objects.hpp"

namespace pelagos {

/// A context for each test; the test is skipped where EGL offers none.
class Graphics : public testing::Test {
 protected:
  void SetUp() override {
    try {
      context_ = std::make_unique<HeadlessContext>();
    } catch (const GraphicsError& error) {
      GTEST_SKIP() << error.what();
    }
  }

 private:
  std::unique_ptr<HeadlessContext> context_;
};

}  // namespace pelagos
