#pragma once

#include <memory>

#include "pelagos_dds/configuration.hpp"

namespace pelagos {

class DdsParticipant;

/// Joins a domain, for those who only pass the participant on. Throws DdsError, which says what to do.
[[nodiscard]] std::shared_ptr<DdsParticipant> join_dds(const DdsSettings& settings);

/// Who can send to the domain that it joined.
[[nodiscard]] DdsReach reach_of(const DdsParticipant& participant);

}  // namespace pelagos
