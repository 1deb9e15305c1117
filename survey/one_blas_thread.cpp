// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/one_blas_thread.h"

#include <dlfcn.h>

#include <initializer_list>

namespace stucco {

// The libraries stand for each other under one name (libblas.so.3); what they have beside BLAS is
// looked up at run time.
bool UseOneBlasThread() {
  bool told = false;
  for (const char* name : {"openblas_set_num_threads", "MKL_Set_Num_Threads"}) {
    if (auto* set = reinterpret_cast<void (*)(int)>(dlsym(RTLD_DEFAULT, name))) {
      set(1);
      told = true;
    }
  }
  // BLIS counts in a type of its own, 64 bits wide unless built otherwise.
  if (auto* set =
          reinterpret_cast<void (*)(long)>(dlsym(RTLD_DEFAULT, "bli_thread_set_num_threads"))) {
    set(1);
    told = true;
  }
  return told;
}

}  // namespace stucco
