#pragma once

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/nouns/forward.h"

/// @file Messages that a control sends as it executes (ISO 10303-238, edition 4).
/// None of this is in ISO 14649. Lengths in mm, angles in rad, times in s.

namespace capstan::model {

/// What a message says; with nothing set, only when it was sent.
struct BroadcastContent : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kBroadcastContent;
  Text its_id;
  Text message;                       ///< optional
  RefList<Noun> measured_properties;  ///< optional
  TextList cbm_measurements;          ///< optional
  TextList adf_measurements;          ///< optional
  TextList pbf_measurements;          ///< optional
  TextList acl_measurements;          ///< optional
  TextList plc_measurements;          ///< optional
  TextList program_contexts;          ///< optional
  Text export_stream;                 ///< optional
  TextList digital_threads;           ///< optional
  Boolean time;                       ///< optional; the time is reported
  Boolean sequence;                   ///< optional; the sequence number is reported
  Boolean only_if_changed;            ///< optional
  Boolean wait_for_reply;             ///< optional
};

struct Broadcast : Noun {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kBroadcast;
  Text its_id;
  Ref<BroadcastContent> start_content;  ///< optional
  Ref<BroadcastContent> end_content;    ///< optional
};

struct BroadcastPoint : Broadcast {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kBroadcastPoint;
  RefList<CartesianPoint> broadcast_points;
  Ref<BroadcastContent> point_content;  ///< optional
};

struct BroadcastCount : Broadcast {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kBroadcastCount;
  Integer broadcast_count;
  Ref<BroadcastContent> count_content;  ///< optional
};

struct BroadcastDistance : Broadcast {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kBroadcastDistance;
  Real broadcast_distance;                 ///< mm
  Ref<BroadcastContent> distance_content;  ///< optional
};

struct BroadcastTime : Broadcast {  // ISO 10303-238 only
  static constexpr TypeId kType = TypeId::kBroadcastTime;
  Real broadcast_interval;             ///< s
  Ref<BroadcastContent> time_content;  ///< optional
};

}  // namespace capstan::model
