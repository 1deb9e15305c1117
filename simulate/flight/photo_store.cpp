// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/flight/photo_store.h"

#include <fmt/format.h>

#include <optional>
#include <set>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/photo_files.h"

namespace stucco::simulate {
namespace {

namespace fs = std::filesystem;

void MakeFolder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return;
  const bool is_full = error == std::errc::no_space_on_device;
  throw Error(is_full ? ErrorKind::kOutOfResource : ErrorKind::kBadInput,
              fmt::format("{}: cannot be created ({})", folder.string(), error.message()),
              is_full ? "make room on the disk" : "choose a folder that you may write to");
}

std::optional<Flight> FlightBefore(const fs::path& survey) {
  std::error_code error;
  if (!fs::exists(survey / kFlightFile, error)) return std::nullopt;
  return ReadFlight(survey);
}

void RequireOurPhotos(const fs::path& survey, const std::optional<Flight>& before) {
  std::error_code error;
  if (!fs::exists(survey / kPhotoFolder, error)) return;
  std::set<std::string> ours;
  if (before) {
    for (const FlownPhoto& photo : before->photos) {
      if (!photo.held_out) ours.insert(photo.path);
    }
  }
  for (const PhotoFile& file : FindPhotoFiles(survey / kPhotoFolder)) {
    if (ours.count(file.path) > 0) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: no simulated flight made this photo",
                            (survey / kPhotoFolder / file.file).string()),
                "simulate into a new survey: real and simulated photos do not mix");
  }
}

// A truth without its flight is not ours: flight.json is the first file that is written into it.
void RequireOurTruth(const fs::path& survey) {
  const fs::path truth = survey / kTruthFolder;
  std::error_code error;
  if (!fs::exists(truth, error)) return;
  for (const auto& entry : fs::recursive_directory_iterator(truth, error)) {
    const bool is_hidden = entry.path().filename().string().starts_with('.');
    if (is_hidden || !entry.is_regular_file(error)) continue;
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: no simulated flight made this file: there is no {}",
                            entry.path().string(), (survey / kFlightFile).string()),
                "simulate into a new survey");
  }
}

std::optional<Flight> RequireFlightOrNothing(const fs::path& survey) {
  auto before = FlightBefore(survey);
  RequireOurPhotos(survey, before);
  if (!before) RequireOurTruth(survey);
  return before;
}

// False where there was nothing. What stays would be taken for a photo of the next flight.
bool Remove(const fs::path& file) {
  std::error_code error;
  const bool removed = fs::remove(file, error);
  if (!error) return removed;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: cannot be removed ({})", file.string(), error.message()),
              "simulate into a new survey");
}

size_t RemovePhotos(const fs::path& survey, const Flight& flight) {
  size_t removed = 0;
  for (const FlownPhoto& photo : flight.photos) {
    if (Remove(PathOfPhoto(survey, photo))) ++removed;
    Remove(PathOfDepth(survey, photo));
  }
  return removed;
}

}  // namespace

fs::path PathOfPhoto(const fs::path& survey, const FlownPhoto& photo) {
  return survey / (photo.held_out ? kTruthFolder : kPhotoFolder) / photo.path;
}

fs::path PathOfDepth(const fs::path& survey, const FlownPhoto& photo) {
  return survey / kTruthFolder / "depth" / (photo.path + ".dmap");
}

void RequireFreeStore(const fs::path& survey) {
  RequireFlightOrNothing(survey);
}

std::vector<std::string> OpenPhotoStore(const fs::path& survey, const Flight& flight) {
  const auto before = RequireFlightOrNothing(survey);
  MakeFolder(survey / kPhotoFolder);
  MakeFolder(survey / kTruthFolder / "held_out");
  std::vector<std::string> notes;
  if (before && before->made_from != flight.made_from) {
    // Before the new truth is written: a kill in between leaves photos that their truth knows.
    const size_t removed = RemovePhotos(survey, *before);
    if (removed > 0) {
      notes.push_back(fmt::format("{} photos of the flight before were replaced", removed));
    }
  }
  WriteFlight(flight, survey);
  return notes;
}

}  // namespace stucco::simulate
