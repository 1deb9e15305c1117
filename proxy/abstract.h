// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "proxy/cloud/input.h"
#include "proxy/options/findings.h"
#include "proxy/options/proxy_options.h"
#include "survey/proxy.h"

namespace stucco {

// The planar model of what the cloud shows: every building closed where its planes close and agree
// with the points, else its seen facets, open; the ground apart as "G0". Throws Error
// (kStageFailed) when the cloud shows no plane.
Proxy AbstractCloud(const ProxyInput& input, const ProxyOptions& options, int threads,
                    ProxyFindings& findings);

}  // namespace stucco
