// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/results/photos_csv.h"

#include <fmt/format.h>

#include <cassert>

#include "calib/scene/resect.h"
#include "survey/escape.h"

namespace stucco {
namespace {

constexpr char kHeader[] =
    "path,candidates,raw_matches,verified_pairs,verified_matches,used_pairs,used_matches,"
    "keypoints,wall_keypoints,coincident_keypoints,points_seen,observations,posed,why";

// Of the pairs of a photo.
struct PairCounts {
  size_t candidates = 0;
  size_t raw_matches = 0;
  size_t verified_pairs = 0;
  size_t verified_matches = 0;
  size_t used_pairs = 0;
  size_t used_matches = 0;
};

std::vector<PairCounts> CountPairs(const PhotoEvidence& evidence, size_t num_photos) {
  std::vector<PairCounts> counts(num_photos);
  for (const TriedPair& pair : evidence.tried) {
    for (const int photo : {pair.first, pair.second}) {
      ++counts[photo].candidates;
      counts[photo].raw_matches += pair.num_matches;
      counts[photo].verified_pairs += pair.num_verified > 0;
      counts[photo].verified_matches += pair.num_verified;
    }
  }
  for (const VerifiedPair& pair : evidence.used) {
    for (const int photo : {pair.pair.first, pair.pair.second}) {
      ++counts[photo].used_pairs;
      counts[photo].used_matches += pair.pair.matches.size();
    }
  }
  return counts;
}

std::string Line(const Scene& scene, int photo, const PairCounts& pairs, const KeypointCounts& k) {
  const bool posed = scene.photos[photo].pose.has_value();
  return fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}", pairs.candidates, pairs.raw_matches,
                     pairs.verified_pairs, pairs.verified_matches, pairs.used_pairs,
                     pairs.used_matches, k.plain, k.on_walls, k.coincident,
                     NumVisiblePoints(scene, photo), posed ? NumUsedObservations(scene, photo) : 0,
                     posed ? "yes" : "no");
}

}  // namespace

std::vector<KeypointCounts> CountKeypoints(const DetectedFeatures& detected,
                                           std::span<const std::vector<int32_t>> places) {
  assert(places.size() == detected.plain.size());
  std::vector<KeypointCounts> counts(places.size());
  for (size_t i = 0; i < counts.size(); ++i) {
    counts[i].plain = detected.plain[i].size();
    counts[i].on_walls = places[i].size() - counts[i].plain;
    for (size_t k = counts[i].plain; k < places[i].size(); ++k) {
      counts[i].coincident += static_cast<size_t>(places[i][k]) < counts[i].plain;
    }
  }
  return counts;
}

std::string PhotosCsv(const SummaryInput& summary, const PhotoEvidence& evidence) {
  const Scene& scene = summary.scene;
  assert(evidence.keypoints.size() == scene.photos.size());
  const std::vector<PairCounts> pairs = CountPairs(evidence, scene.photos.size());
  std::vector<int> photo_of_capture(summary.captures.photos.size(), -1);
  for (size_t i = 0; i < summary.capture_of_photo.size(); ++i) {
    photo_of_capture[summary.capture_of_photo[i]] = static_cast<int>(i);
  }
  std::string csv = std::string(kHeader) + "\r\n";
  for (size_t c = 0; c < photo_of_capture.size(); ++c) {
    const CapturedPhoto& captured = summary.captures.photos[c];
    const int photo = photo_of_capture[c];
    csv += CsvField(captured.path) + ",";
    if (photo < 0) {
      csv += ",,,,,,,,,,,no," + CsvField(captured.why) + "\r\n";
      continue;
    }
    csv += Line(scene, photo, pairs[photo], evidence.keypoints[photo]);
    const auto why = summary.unregistered.find(photo);
    csv += "," + (why == summary.unregistered.end() ? "" : CsvField(why->second)) + "\r\n";
  }
  return csv;
}

}  // namespace stucco
