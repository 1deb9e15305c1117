// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/design_wall.h"

#include <algorithm>
#include <cmath>

#include "simulate/random.h"

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;

// What the walls of a house have in common.
struct Manner {
  double bay_m = 2.8;  // from window to window
  double window_width_m = 1.2;
  double window_height_m = 1.5;
  double sill_m = 0.9;     // above the floor
  double recess_m = 0.15;  // of windows
  double balcony_m = 0;    // how far balconies stand out; 0: none
  double loggia_m = 0;     // how far loggias are set back; 0: none
  int balcony_every = 3;   // bays
  int loggia_bay = 1;
  bool shops = false;
  double cornice_m = 0;  // how far it stands out; 0: none
  double door_width_m = 1.1;
  double ledge_m = 0.1;  // how far those of a curtain wall stand out
};

constexpr double kMargin_m = 0.7;    // from the end of a wall to a window
constexpr double kRailing_m = 1.05;  // above the floor

Manner MannerOf(const House& house) {
  Random random(house.seed, 1);
  Manner m;
  m.window_width_m = random.Uniform(1.05, 1.45);
  m.window_height_m = std::min(random.Uniform(1.35, 1.7), house.storey_m - 1.35);
  m.sill_m = random.Uniform(0.8, 0.95);
  m.recess_m = random.Uniform(0.12, 0.3);
  m.bay_m = m.window_width_m + random.Uniform(1.2, 1.9);
  switch (house.use) {
    case HouseUse::kHome:
      if (random.Chance(0.5)) m.balcony_m = random.Uniform(0.9, 1.4);
      m.balcony_every = 3;
      break;
    case HouseUse::kTenement:
      m.window_height_m = std::min(random.Uniform(1.6, 1.95), house.storey_m - 1.25);
      m.shops = random.Chance(0.55);
      m.cornice_m = random.Chance(0.7) ? random.Uniform(0.2, 0.45) : 0;
      if (random.Chance(0.55)) m.balcony_m = random.Uniform(0.8, 1.3);
      m.balcony_every = random.Integer(2, 4);
      m.door_width_m = 1.6;
      break;
    case HouseUse::kTower:
      m.bay_m = m.window_width_m + random.Uniform(1.1, 1.6);
      if (random.Chance(0.6)) m.balcony_m = random.Uniform(0.9, 1.5);
      if (random.Chance(0.6)) m.loggia_m = random.Uniform(0.6, 1.5);
      m.balcony_every = random.Integer(3, 4);
      m.loggia_bay = random.Integer(1, 2);
      m.shops = random.Chance(0.5);
      m.door_width_m = 1.8;
      break;
    case HouseUse::kHall:
      m.window_width_m = random.Uniform(1.4, 2.2);
      m.window_height_m = random.Uniform(1.7, 2.1);
      m.bay_m = m.window_width_m + random.Uniform(0.8, 1.4);
      m.recess_m = random.Uniform(0.2, 0.4);
      m.cornice_m = random.Chance(0.4) ? random.Uniform(0.2, 0.4) : 0;
      m.door_width_m = 2.4;
      break;
  }
  m.ledge_m = random.Uniform(0.08, 0.3);
  if (house.repeats) {
    m.balcony_m = 0;
    m.loggia_m = 0;
    m.shops = false;
  }
  return m;
}

class Designer {
 public:
  Designer(const House& house, const WallPlace& place)
      : house_(house),
        place_(place),
        manner_(MannerOf(house)),
        random_(house.seed, 100 + place.edge) {
    design_.width_m = place.width_m;
    design_.height_m = place.top_m - house.base_m;
    design_.cladding = house.cladding;
    design_.palette = house.palette;
    design_.seed = house.seed;
    design_.wall = place.edge;
    for (int storey = house.storeys; storey >= 0; --storey) {
      design_.floors_m.push_back(Y(FloorOf(storey)));
    }
  }

  WallDesign Design() {
    if (house_.party[place_.edge]) return design_;
    AddBands();
    const double usable = place_.width_m - 2 * kMargin_m;
    bays_ = static_cast<int>((usable - manner_.window_width_m) / manner_.bay_m) + 1;
    if (usable < manner_.window_width_m) bays_ = 0;
    if (house_.repeats && bays_ > 0) design_.repeated_bay_m = place_.width_m / bays_;
    for (int storey = 0; storey < house_.storeys; ++storey) {
      if (storey == 0 && bays_ > 0) {
        AddGroundFloor();
      } else if (IsCurtain()) {
        if (storey > 0) AddLedge(storey);
      } else {
        for (int bay = 0; bay < bays_; ++bay) AddUpper(storey, bay);
      }
    }
    if (place_.gable_rise_m > 0 && !IsCurtain()) AddGableWindows();
    return design_;
  }

 private:
  double FloorOf(int storey) const { return house_.floor_m + storey * house_.storey_m; }
  double Y(double z) const { return place_.top_m - z; }
  // Middle of a bay; bays are spread evenly.
  double X(int bay) const { return place_.width_m * (bay + 0.5) / bays_; }
  // A curtain wall is all window; its panes are painted with the wall.
  bool IsCurtain() const { return house_.cladding == Cladding::kGlass; }
  bool IsFront() const { return house_.front[place_.edge]; }

  struct Place {
    double x, width, bottom_z, top_z;  // x: of its middle
  };

  void Add(PartKind kind, const Place& place, double relief_m) {
    design_.parts.push_back({.kind = kind,
                             .top_left = {place.x - place.width / 2, Y(place.top_z)},
                             .bottom_right = {place.x + place.width / 2, Y(place.bottom_z)},
                             .relief_m = relief_m,
                             .variant = house_.repeats ? static_cast<uint32_t>(house_.seed)
                                                       : static_cast<uint32_t>(random_.Next())});
  }

  // The plinth is painted flush with the wall; a cornice stands out.
  void AddBands() {
    const double middle = place_.width_m / 2;
    const double plinth_top = house_.floor_m - 0.02;
    if (plinth_top - house_.base_m > 0.1) {
      Add(PartKind::kPlinth, {middle, place_.width_m, house_.base_m, plinth_top}, 0);
    }
    if (manner_.cornice_m > 0 && place_.gable_rise_m == 0 && house_.roof == RoofShape::kFlat) {
      Add(PartKind::kCornice, {middle, place_.width_m, place_.top_m - 0.45, place_.top_m - 0.1},
          manner_.cornice_m);
    }
  }

  void AddLedge(int storey) {
    const double floor = FloorOf(storey);
    Add(PartKind::kLedge, {place_.width_m / 2, place_.width_m, floor - 0.22, floor},
        manner_.ledge_m);
  }

  void AddWindow(int storey, double x) {
    if (IsCurtain()) return;
    const double sill = FloorOf(storey) + manner_.sill_m;
    Add(PartKind::kWindow, {x, manner_.window_width_m, sill, sill + manner_.window_height_m},
        -manner_.recess_m);
  }

  // Set back as a room without a front; the parapet below it belongs to the wall.
  void AddLoggia(int storey, double x, double width) {
    const double floor = FloorOf(storey);
    Add(PartKind::kWindow, {x, width, floor + kRailing_m, floor + house_.storey_m - 0.4},
        -manner_.loggia_m);
  }

  void AddBalcony(int storey, double x) {
    const double floor = FloorOf(storey);
    Add(PartKind::kBalconyDoor,
        {x, std::min(1.6, manner_.window_width_m + 0.3), floor + 0.04,
         floor + std::min(2.3, house_.storey_m - 0.5)},
        -manner_.recess_m);
    Add(PartKind::kBalcony, {x, BalconyWidth(), floor - kBalconySlab_m, floor + kRailing_m},
        manner_.balcony_m);
  }

  double BalconyWidth() const { return std::min(manner_.bay_m + 0.35, 3.2); }

  bool HasBalcony(int storey, int bay) const {
    if (manner_.balcony_m == 0 || storey == 0) return false;
    const double reach = BalconyWidth() / 2;
    if (X(bay) - reach < 0.1 || X(bay) + reach > place_.width_m - 0.1) return false;
    const bool wanted =
        house_.use == HouseUse::kTower || !IsFront() || house_.use == HouseUse::kTenement;
    // Neighbouring bays are never both chosen: their slabs would meet.
    return wanted && bay % std::max(2, manner_.balcony_every) == 1;
  }

  // None in the first and the last bay: it would run into what is set back in the next wall.
  bool HasLoggia(int bay) const {
    return manner_.loggia_m > 0 && bay % 4 == manner_.loggia_bay + 1 && bay > 0 && bay + 1 < bays_;
  }

  void AddUpper(int storey, int bay) {
    if (HasBalcony(storey, bay)) {
      AddBalcony(storey, X(bay));
    } else if (HasLoggia(bay)) {
      AddLoggia(storey, X(bay), std::min(2.4, place_.width_m / bays_ - 0.5));
    } else {
      AddWindow(storey, X(bay));
    }
  }

  // A house has its door in a wall to the street; tenements and towers one to the courtyard too.
  void AddGroundFloor() {
    const bool has_door = !house_.repeats && (IsFront() || house_.use != HouseUse::kHome);
    const int door = has_door ? random_.Index(bays_) : -1;
    const double floor = FloorOf(0);
    const double bay = place_.width_m / bays_;
    for (int i = 0; i < bays_; ++i) {
      const bool is_shop = manner_.shops && IsFront() && i != door;
      if (i == door) {
        const double width = std::min(manner_.door_width_m, bay - 0.5);
        Add(PartKind::kDoor, {X(i), width, floor, floor + std::min(2.35, house_.storey_m - 0.5)},
            -std::max(0.25, manner_.recess_m));
      } else if (is_shop) {
        const double width = std::min({bay - 0.45, 3.2, 2 * (X(0) - 0.35)});
        Add(PartKind::kShopWindow,
            {X(i), width, floor + 0.45, floor + std::min(2.75, house_.storey_m - 0.4)}, -0.3);
      } else {
        AddWindow(0, X(i));
      }
    }
  }

  // As many as the triangle has room for, in rows from its foot upwards.
  void AddGableWindows() {
    const double half = place_.width_m / 2;
    const double width = std::min(manner_.window_width_m, 1.1);
    const double height = std::min(manner_.window_height_m, 1.3);
    const double slope = place_.gable_rise_m / half;
    for (double sill = house_.eaves_m() + 0.6;; sill += 2.7) {
      const double top = sill + height + 0.45;
      const double reach = half - (top - house_.eaves_m()) / slope;  // half the room at the top
      if (reach < width / 2) return;
      const int count = reach > 1.6 * width ? 2 : 1;
      for (int i = 0; i < count; ++i) {
        const double x = half + (count == 1 ? 0 : (i - 0.5) * 1.9 * width);
        Add(PartKind::kWindow, {x, width, sill, sill + height}, -manner_.recess_m);
      }
    }
  }

  const House& house_;
  const WallPlace& place_;
  const Manner manner_;
  Random random_;
  WallDesign design_;
  int bays_ = 0;
};

}  // namespace

bool HasBalconies(const House& house) {
  return house.storeys > 1 && house.cladding != Cladding::kGlass && MannerOf(house).balcony_m > 0;
}

WallDesign DesignWall(const House& house, const WallPlace& place) {
  WallDesign design = Designer(house, place).Design();
  design.repainted = place.edge == house.repainted_edge;
  return design;
}

}  // namespace stucco::simulate
