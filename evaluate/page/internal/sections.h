// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

#include "evaluate/figures/evaluation.h"

namespace stucco::evaluate::internal {

// The files of evaluate/page/web and what is borrowed from report/web.
std::string_view PageStyle();
std::string_view PageScript();

// Sections of the page; empty where there is nothing to say.
std::string HeadlineSection(const Evaluation& evaluation);
std::string FacadesSection(const Evaluation& evaluation);
std::string ViewsSection(const Evaluation& evaluation);
std::string NotesSection(const Evaluation& evaluation);
std::string MeasuresSection(const Evaluation& evaluation);

// One figure with its name: "<div class="figure">...". A dash where it was not measured.
std::string FigureHtml(std::string_view name, const std::string& value, std::string_view note = "");

// Figures of pictures in one row, with what they stand for.
std::string PictureFiguresHtml(const PictureFigures& figures);

}  // namespace stucco::evaluate::internal
