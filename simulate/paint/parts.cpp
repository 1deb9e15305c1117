// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>

#include "simulate/paint/internal/openings.h"

namespace stucco::simulate::internal {
namespace {

// How far a part may paint beyond its own edges: surrounds, sills, shutters.
Box Reach(const Box& box) {
  return {box.left - 0.3f - 0.55f * box.Width(), box.top - 0.4f,
          box.right + 0.3f + 0.55f * box.Width(), box.bottom + 0.4f};
}

// Room for open shutters: nothing else stands or hangs within half a window's width.
bool HasRoomBeside(const WallLook& look, const Box& box) {
  const float leaf = box.Width() / 2 + 0.05f;
  if (box.left < leaf || box.right + leaf > look.width_m) return false;
  const Box wide = {box.left - leaf, box.top, box.right + leaf, box.bottom};
  int meeting = 0;
  for (const WallPart& other : look.design->parts) {
    const Box its = BoxOf(other);
    const float more = other.kind == PartKind::kWindow ? its.Width() / 2 : 0;
    if (Meet(wide, {its.left - more, its.top, its.right + more, its.bottom})) ++meeting;
  }
  return meeting <= 1;  // itself
}

void PaintAround(Tile& tile, const WallLook& look, const WallPart& part) {
  const Box box = BoxOf(part);
  const bool window = part.kind == PartKind::kWindow;
  if (look.surrounds) {
    PaintSurround(tile, look, box);
  } else if (look.design->cladding == Cladding::kBrick) {
    PaintSoldierCourse(tile, look, {box.left - 0.11f, box.top - 0.24f, box.right + 0.11f, box.top});
  }
  if (window && look.shutters && HasRoomBeside(look, box)) {
    const float leaf = box.Width() / 2;
    PaintShutter(tile, look, {box.left - leaf - 0.02f, box.top, box.left - 0.02f, box.bottom});
    PaintShutter(tile, look, {box.right + 0.02f, box.top, box.right + 0.02f + leaf, box.bottom});
  }
  if (window && look.design->cladding != Cladding::kGlass) PaintSill(tile, look, box);
}

}  // namespace

void PaintPart(Tile& tile, const WallLook& look, const WallPart& part) {
  const Box box = BoxOf(part);
  // Written so that a box of NaN is left out as well.
  if (!(box.Width() > 0 && box.Height() > 0)) return;
  if (!Meet(Reach(box), tile.Extent())) return;
  switch (part.kind) {
    case PartKind::kWindow:
    case PartKind::kBalconyDoor:
      PaintAround(tile, look, part);
      PaintWindow(tile, look, part);
      break;
    case PartKind::kDoor:
      PaintAround(tile, look, part);
      PaintDoor(tile, look, part);
      break;
    case PartKind::kShopWindow:
      PaintShopWindow(tile, look, part);
      break;
    case PartKind::kBalcony:
      PaintBalcony(tile, look, part);
      break;
    case PartKind::kCornice:
      PaintCornice(tile, look, part);
      break;
    case PartKind::kLedge:
      PaintLedge(tile, look, part);
      break;
    case PartKind::kPlinth:
      PaintPlinth(tile, look, part);
      break;
  }
}

}  // namespace stucco::simulate::internal
