#pragma once

#include "current.pb.h"
#include "values/current.hpp"
#include "values/wind.hpp"
#include "wind.pb.h"

namespace pelagos {

// Choices as the schema names them.

[[nodiscard]] inline proto::v1::Wind::Law law_of(WindLaw law) {
  switch (law) {
    case WindLaw::kGust:
      return proto::v1::Wind::GUST;
    case WindLaw::kStress:
      return proto::v1::Wind::STRESS;
    case WindLaw::kPaper:
      return proto::v1::Wind::PAPER;
  }
  return proto::v1::Wind::LAW_DEFAULT;
}

[[nodiscard]] inline proto::v1::Current::Shear shear_of(CurrentShear shear) {
  switch (shear) {
    case CurrentShear::kNone:
      return proto::v1::Current::NONE;
    case CurrentShear::kLinear:
      return proto::v1::Current::LINEAR;
    case CurrentShear::kSeventhPower:
      return proto::v1::Current::SEVENTH_POWER;
  }
  return proto::v1::Current::SHEAR_DEFAULT;
}

}  // namespace pelagos
