// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/records.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "calib/records/flight_ties.h"
#include "calib/records/heading.h"
#include "calib/records/position_witnesses.h"
#include "survey/attitude.h"
#include "survey/median.h"

namespace stucco {
namespace {

constexpr int kEnoughAtAll = 4;
constexpr double kSignificant = 3;  // of its own standard deviation
constexpr double kLeastHover_m = 0.02;
// Gimbals are no better than they write.
constexpr double kLeastAttitude_rad = 0.05 * std::numbers::pi / 180;
constexpr int kReweightings = 10;
// Median of the length of a three-dimensional normal vector with unit variances.
constexpr double kMaxwellMedian = 1.5382;
constexpr double kExpectedMount_rad = 2 * std::numbers::pi / 180;
constexpr double kExpectedTilt_rad = 5 * std::numbers::pi / 180;
// Flights that nothing ties have their heading from their own positions, to no better than this.
constexpr double kUntiedYaw_rad = 2 * std::numbers::pi / 180;
constexpr double kExpectedYaw_rad = 10 * std::numbers::pi / 180;  // that is left

double MedianOf(std::vector<double> values) {
  return Median(std::move(values)).value_or(0);
}

// By photo, cam_from_world.
using Poses = std::vector<std::optional<Pose>>;

// The scene's poses turned about up, about the middle of the photos.
struct TurnedPoses {
  Poses poses;
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
};

TurnedPoses TurnPoses(const Scene& scene, double turn_rad) {
  TurnedPoses turned;
  int num_posed = 0;
  for (const ScenePhoto& photo : scene.photos) {
    if (!photo.pose) continue;
    turned.middle += photo.pose->Center().head<2>();
    ++num_posed;
  }
  if (num_posed > 0) turned.middle /= num_posed;
  const Eigen::Vector3d middle(turned.middle.x(), turned.middle.y(), 0);
  const Eigen::Quaterniond rotation = AboutUp(turn_rad);
  const Similarity turn{1, rotation, middle - rotation * middle};
  for (const ScenePhoto& photo : scene.photos) {
    turned.poses.push_back(photo.pose ? std::optional(Transformed(*photo.pose, turn))
                                      : std::nullopt);
  }
  return turned;
}

// Positions

struct PositionError {
  int flight = 0;
  Eigen::Vector3d posed = Eigen::Vector3d::Zero();
  Eigen::Vector3d recorded_minus_posed = Eigen::Vector3d::Zero();
  Eigen::Vector3d stated = Eigen::Vector3d::Ones();  // standard deviations
};

std::vector<PositionError> PositionErrors(const std::vector<PoseRecord>& records,
                                          const std::vector<bool>& tells, const Poses& poses) {
  std::vector<PositionError> errors;
  for (size_t i = 0; i < records.size(); ++i) {
    if (!tells[i]) continue;
    const PositionPrior& recorded = *records[i].position;
    errors.push_back(
        {records[i].flight,
         poses[i]->Center(),
         recorded.position - poses[i]->Center(),
         {recorded.sigma_horizontal_m, recorded.sigma_horizontal_m, recorded.sigma_vertical_m}});
  }
  return errors;
}

Eigen::Vector3d MedianVector(const std::vector<Eigen::Vector3d>& vectors) {
  Eigen::Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    values.reserve(vectors.size());
    for (const Eigen::Vector3d& v : vectors) values.push_back(v[axis]);
    median[axis] = MedianOf(std::move(values));
  }
  return median;
}

Eigen::Vector3d MedianShift(const std::vector<PositionError>& errors) {
  std::vector<Eigen::Vector3d> shifts;
  shifts.reserve(errors.size());
  for (const PositionError& error : errors) shifts.push_back(error.recorded_minus_posed);
  return MedianVector(shifts);
}

// Of errors about zero.
void SetSigmas(const std::vector<PositionError>& errors, FlightErrors& flight) {
  std::vector<Eigen::Vector3d> over_stated;
  std::vector<Eigen::Vector3d> stated;
  for (const PositionError& error : errors) {
    over_stated.emplace_back(error.recorded_minus_posed.cwiseQuotient(error.stated).cwiseAbs());
    stated.push_back(error.stated);
  }
  // A model that bends shows as noise of positions: they are not worse than they state.
  const Eigen::Vector3d ratio =
      (MedianVector(over_stated) / kMedianOfNormal).cwiseMin(Eigen::Vector3d::Ones());
  const Eigen::Vector3d usual = MedianVector(stated);
  flight.horizontal_over_stated = std::hypot(ratio.x(), ratio.y()) / std::sqrt(2.0);
  flight.vertical_over_stated = ratio.z();
  flight.sigma_horizontal_m = std::max(kLeastPosition_m, flight.horizontal_over_stated * usual.x());
  flight.sigma_vertical_m = std::max(kLeastPosition_m, flight.vertical_over_stated * usual.z());
}

// What positions are measured against: the shift that all flights share, and how surely the scene
// is turned as they say, about its middle.
struct PositionFrame {
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  double sigma_heading_rad = 0;
};

// Takes the flight's shift off its errors and measures what is left.
void MeasureFlight(const PositionFrame& frame, const FlightTie& tie,
                   std::vector<PositionError>& errors, FlightErrors& flight) {
  const Eigen::Vector3d shift = MedianShift(errors);
  for (PositionError& error : errors) error.recorded_minus_posed -= shift;
  SetSigmas(errors, flight);
  // The standard deviation of a median of normal variables is this many times that of the mean.
  constexpr double kMedianOverMean = 1.25;
  const double own =
      kMedianOverMean * flight.sigma_horizontal_m / std::sqrt(static_cast<double>(errors.size()));
  Eigen::Vector2d arm = -frame.middle;
  for (const PositionError& error : errors) {
    arm += error.posed.head<2>() / static_cast<double>(errors.size());
  }
  const double turned = frame.sigma_heading_rad * arm.norm();
  if ((shift - frame.shift).norm() > kSignificant * std::hypot(own, tie.position_m, turned)) {
    flight.shift_m = shift - frame.shift;
  }
}

void MeasurePositions(const std::vector<PositionError>& all, PositionFrame frame,
                      const std::vector<FlightTie>& ties, std::vector<FlightErrors>& flights) {
  if (all.size() < kEnoughForOneFlight) return;
  std::vector<std::vector<PositionError>> by_flight(flights.size());
  for (const PositionError& error : all) by_flight[error.flight].push_back(error);
  for (const auto& of_flight : by_flight) {
    if (of_flight.empty()) continue;
    frame.shift += static_cast<double>(of_flight.size()) / static_cast<double>(all.size()) *
                   MedianShift(of_flight);
  }
  std::vector<PositionError> together;
  for (size_t f = 0; f < flights.size(); ++f) {
    if (by_flight[f].size() < kEnoughForOneFlight) {
      for (PositionError& error : by_flight[f]) error.recorded_minus_posed -= frame.shift;
    } else {
      MeasureFlight(frame, ties[f], by_flight[f], flights[f]);
    }
    together.insert(together.end(), by_flight[f].begin(), by_flight[f].end());
  }
  for (size_t f = 0; f < flights.size(); ++f) {
    if (by_flight[f].size() < kEnoughForOneFlight) SetSigmas(together, flights[f]);
  }
}

// Of single photos about the places of their hovers.
double MeasureHovers(const std::vector<PoseRecord>& records, const Scene& scene) {
  std::map<int, std::vector<Eigen::Vector3d>> places;
  for (size_t i = 0; i < records.size(); ++i) {
    if (records[i].hover < 0 || !scene.photos[i].pose) continue;
    places[records[i].hover].push_back(scene.photos[i].pose->Center());
  }
  std::vector<double> apart;
  for (const auto& [hover, of_hover] : places) {
    for (size_t a = 0; a < of_hover.size(); ++a) {
      for (size_t b = a + 1; b < of_hover.size(); ++b) {
        apart.push_back((of_hover[a] - of_hover[b]).norm());
      }
    }
  }
  if (apart.size() < kEnoughForOneFlight) return 0;
  return std::max(kLeastHover_m, MedianOf(std::move(apart)) / std::sqrt(2.0) / kMaxwellMedian);
}

// Attitudes

struct AttitudePair {
  int flight = 0;
  Eigen::Quaterniond posed;     // cam_from_world
  Eigen::Quaterniond recorded;  // cam_from_world
};

std::vector<AttitudePair> AttitudePairs(const std::vector<PoseRecord>& records,
                                        const Poses& poses) {
  std::vector<AttitudePair> pairs;
  for (size_t i = 0; i < records.size(); ++i) {
    if (!poses[i] || !records[i].gimbal) continue;
    pairs.push_back({records[i].flight, poses[i]->rotation, *records[i].gimbal});
  }
  return pairs;
}

// Turn about up that takes the recorded attitude nearest to the posed one.
double YawOf(const AttitudePair& pair) {
  const Eigen::Quaterniond world = pair.recorded.conjugate() * pair.posed;
  return 2 * std::atan2(world.z(), world.w());
}

// Median of angles, about their mean direction.
double MedianAngle(const std::vector<double>& angles) {
  double cosine = 0;
  double sine = 0;
  for (const double angle : angles) {
    cosine += std::cos(angle);
    sine += std::sin(angle);
  }
  const double mean = std::atan2(sine, cosine);
  std::vector<double> about;
  about.reserve(angles.size());
  for (const double angle : angles)
    about.push_back(std::remainder(angle - mean, 2 * std::numbers::pi));
  return mean + MedianOf(std::move(about));
}

// Which of the unknowns mount (3), turn of the scene (3: tilt and heading) and yaw of each flight
// (1 each) take part.
struct AttitudeUnknowns {
  bool mount = true;
  std::vector<bool> yaw;
  double sigma_heading_rad = 0;  // of the scene, which is zero in the mean

  int turn_index() const { return mount ? 3 : 0; }
  int size() const {
    return turn_index() + 3 + static_cast<int>(std::count(yaw.begin(), yaw.end(), true));
  }
  int yaw_index(int flight) const {
    return turn_index() + 3 + static_cast<int>(std::count(yaw.begin(), yaw.begin() + flight, true));
  }
  // What is expected beforehand, all about zero, as a weight against observations of this standard
  // deviation: where all photos look down, nothing else tells a turned mount from a compass.
  Eigen::MatrixXd Expected(double sigma_rad) const {
    Eigen::VectorXd sigmas(size());
    sigmas.setConstant(kExpectedYaw_rad);
    if (mount) sigmas.head<3>().setConstant(kExpectedMount_rad);
    sigmas.segment<2>(turn_index()).setConstant(kExpectedTilt_rad);
    sigmas[turn_index() + 2] = sigma_heading_rad;
    return (sigma_rad / sigmas.array()).square().matrix().asDiagonal();
  }
};

struct AttitudeFit {
  Eigen::VectorXd values;
  Eigen::VectorXd sigmas;
  double sigma_rad = 0;  // of a record, about each axis
};

// Least squares with Cauchy weights (Triggs et al. 2000, section 3.3) of
//   log(R G^-1) = mount + G (tilt, heading + yaw):
// what turns with the camera and what stays with the world tell apart by the ways photos look.
AttitudeFit FitAttitudes(const std::vector<AttitudePair>& pairs, const AttitudeUnknowns& unknowns) {
  const int size = unknowns.size();
  AttitudeFit fit{Eigen::VectorXd::Zero(size), Eigen::VectorXd::Zero(size), kLeastAttitude_rad};
  std::vector<Eigen::MatrixXd> rows;
  std::vector<Eigen::Vector3d> right;
  for (const AttitudePair& pair : pairs) {
    Eigen::MatrixXd row = Eigen::MatrixXd::Zero(3, size);
    const Eigen::Matrix3d g = pair.recorded.toRotationMatrix();
    if (unknowns.mount) row.leftCols<3>().setIdentity();
    row.middleCols<3>(unknowns.turn_index()) = g;
    if (unknowns.yaw[pair.flight]) row.col(unknowns.yaw_index(pair.flight)) = g.col(2);
    rows.push_back(row);
    right.push_back(RotationVector(pair.posed * pair.recorded.conjugate()));
  }
  double scale = 0.05;
  for (int round = 0; round < kReweightings; ++round) {
    Eigen::MatrixXd normal = unknowns.Expected(scale);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(size);
    for (size_t i = 0; i < rows.size(); ++i) {
      const double r = (right[i] - rows[i] * fit.values).norm() / (2 * scale);
      const double weight = 1 / (1 + r * r);
      normal += weight * rows[i].transpose() * rows[i];
      sum += weight * rows[i].transpose() * right[i];
    }
    const Eigen::LDLT<Eigen::MatrixXd> factors(normal);
    fit.values = factors.solve(sum);
    // Of whole turns, as poses are judged by them: compasses are worse than levels, and the middle
    // one of all axes would be that of a level.
    std::vector<double> turns;
    turns.reserve(rows.size());
    for (size_t i = 0; i < rows.size(); ++i) {
      turns.push_back((right[i] - rows[i] * fit.values).norm());
    }
    scale = std::max(kLeastAttitude_rad, MedianOf(std::move(turns)) / kMaxwellMedian);
    fit.sigmas =
        scale * factors.solve(Eigen::MatrixXd::Identity(size, size)).diagonal().cwiseSqrt();
  }
  fit.sigma_rad = scale;
  return fit;
}

// With the compass's error of each flight taken off.
AttitudeFit FitTurned(std::vector<AttitudePair> pairs, const std::vector<FlightErrors>& flights,
                      const AttitudeUnknowns& unknowns) {
  for (AttitudePair& pair : pairs) {
    pair.recorded = pair.recorded * AboutUp(flights[pair.flight].yaw_rad);
  }
  return FitAttitudes(pairs, unknowns);
}

// Any angle that a compass may be off by: what is linear in the fit is the rest.
AttitudeUnknowns GuessYaws(const std::vector<AttitudePair>& pairs, double sigma_heading_rad,
                           std::vector<FlightErrors>& flights) {
  std::vector<std::vector<double>> yaws(flights.size());
  for (const AttitudePair& pair : pairs) yaws[pair.flight].push_back(YawOf(pair));
  AttitudeUnknowns unknowns{true, std::vector<bool>(flights.size(), false), sigma_heading_rad};
  for (size_t f = 0; f < yaws.size(); ++f) {
    if (yaws[f].empty()) continue;
    flights[f].yaw_rad = MedianAngle(yaws[f]);
    unknowns.yaw[f] = yaws[f].size() >= kEnoughAtAll;
  }
  return unknowns;
}

void MeasureAttitudes(const std::vector<PoseRecord>& records, const Poses& poses,
                      double sigma_heading_rad, const std::vector<FlightTie>& ties,
                      RecordErrors& errors) {
  const std::vector<AttitudePair> pairs = AttitudePairs(records, poses);
  if (pairs.size() < kEnoughAtAll) return;
  std::vector<FlightErrors>& flights = errors.flights;
  AttitudeUnknowns unknowns = GuessYaws(pairs, sigma_heading_rad, flights);
  AttitudeFit fit = FitTurned(pairs, flights, unknowns);
  const AttitudeUnknowns before = unknowns;
  for (size_t f = 0; f < flights.size(); ++f) {
    const int index = before.yaw[f] ? before.yaw_index(static_cast<int>(f)) : -1;
    const double yaw = flights[f].yaw_rad + (index < 0 ? 0 : fit.values[index]);
    const double tied = std::min(ties[f].yaw_rad, kUntiedYaw_rad);
    const double sigma = index < 0 ? std::numbers::pi : std::hypot(tied, fit.sigmas[index]);
    if (std::abs(yaw) >= kSignificant * sigma) continue;
    flights[f].yaw_rad = 0;
    unknowns.yaw[f] = false;
  }
  fit = FitTurned(pairs, flights, unknowns);
  errors.sigma_tilt_rad = fit.sigmas.segment<2>(3).maxCoeff();
  const Eigen::Array3d mount = fit.values.head<3>().array() / fit.sigmas.head<3>().array();
  if ((mount.abs() < kSignificant).all()) {
    unknowns.mount = false;
    fit = FitTurned(pairs, flights, unknowns);
  }
  if (unknowns.mount) errors.mount_rad = fit.values.head<3>();
  errors.tilt_rad.head<2>() = fit.values.segment<2>(unknowns.turn_index());
  errors.sigma_attitude_rad = fit.sigma_rad;
  for (size_t f = 0; f < flights.size(); ++f) {
    if (!unknowns.yaw[f]) continue;
    flights[f].yaw_rad += fit.values[unknowns.yaw_index(static_cast<int>(f))];
  }
}

}  // namespace

RecordErrors MeasureRecordErrors(const std::vector<PoseRecord>& records, const Scene& scene) {
  assert(records.size() == scene.photos.size());
  int num_flights = 1;
  for (const PoseRecord& record : records) num_flights = std::max(num_flights, record.flight + 1);
  RecordErrors errors;
  errors.flights.resize(num_flights);
  for (size_t i = 0; i < records.size(); ++i) {
    const bool counts = scene.photos[i].pose && (records[i].position || records[i].gimbal);
    errors.flights[records[i].flight].num_photos += counts;
  }
  std::vector<int> flight_of_photo;
  flight_of_photo.reserve(records.size());
  for (const PoseRecord& record : records) flight_of_photo.push_back(record.flight);
  const std::vector<FlightTie> ties = TiesOfFlights(flight_of_photo, scene);
  const SceneHeading heading = HeadingByPositions(records, scene);
  // Turned as positions say: what all flights' compasses have in common with a scene that has
  // turned away from its records would be taken for theirs, and hold it there. Control knows
  // better.
  const double turn_rad = scene.control.points.size() < 2 ? heading.turn_rad : 0;
  const TurnedPoses turned = TurnPoses(scene, turn_rad);
  const std::vector<PositionError> positions =
      PositionErrors(records, PositionWitnesses(records, scene), turned.poses);
  MeasurePositions(positions, {Eigen::Vector3d::Zero(), turned.middle, heading.sigma_rad}, ties,
                   errors.flights);
  MeasureAttitudes(records, turned.poses, heading.sigma_rad, ties, errors);
  errors.sigma_hover_m = MeasureHovers(records, scene);
  return errors;
}

std::optional<double> UpSigma_rad(const RecordErrors& errors) {
  if (errors.sigma_tilt_rad < 0) return std::nullopt;
  return std::hypot(errors.sigma_tilt_rad, errors.tilt_rad.norm(), kLeastAttitude_rad);
}

std::optional<PositionPrior> CorrectedPosition(const PoseRecord& record,
                                               const RecordErrors& errors) {
  if (!record.position) return std::nullopt;
  const FlightErrors& flight = errors.flights[record.flight];
  PositionPrior prior = *record.position;
  prior.position -= flight.shift_m;
  prior.sigma_horizontal_m =
      std::max(kLeastPosition_m, flight.horizontal_over_stated * prior.sigma_horizontal_m);
  prior.sigma_vertical_m =
      std::hypot(std::max(kLeastPosition_m, flight.vertical_over_stated * prior.sigma_vertical_m),
                 record.height_zero_sigma_m);
  return prior;
}

void ApplyRecords(const std::vector<PoseRecord>& records, const RecordErrors& errors,
                  Scene& scene) {
  assert(records.size() == scene.photos.size());
  const Eigen::Quaterniond mount = FromRotationVector(errors.mount_rad);
  scene.hover_sigma_m = errors.sigma_hover_m;
  for (size_t i = 0; i < records.size(); ++i) {
    ScenePhoto& photo = scene.photos[i];
    photo.prior = CorrectedPosition(records[i], errors);
    photo.hover = records[i].hover;
    photo.may_be_bays_off = records[i].may_be_bays_off;
    photo.attitude.reset();
    if (!records[i].gimbal) continue;
    const FlightErrors& flight = errors.flights[records[i].flight];
    photo.attitude =
        AttitudePrior{(mount * *records[i].gimbal * AboutUp(flight.yaw_rad)).normalized(),
                      errors.sigma_attitude_rad};
  }
}

}  // namespace stucco
