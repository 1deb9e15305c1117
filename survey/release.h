// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace stucco {

// Empties a container and gives its memory back, which clear() and assigning {} do not.
template <typename Container>
void Release(Container& container) {
  Container().swap(container);
}

}  // namespace stucco
