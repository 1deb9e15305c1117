// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/report.h"

#include <fmt/format.h>

#include <vector>

#include "report/facet_rows.h"
#include "report/pictures.h"
#include "report/report_html.h"
#include "report/report_json.h"
#include "report/survey_data.h"
#include "survey/files.h"
#include "survey/parallel.h"
#include "survey/plan_of_survey.h"

namespace stucco {
namespace {

std::vector<FacetPictures> MakePictures(const std::vector<FacetRow>& rows,
                                        const ReportOptions& options, const StageContext& context) {
  const int side_px = PictureSide_px(options.picture_px, rows.size());
  std::vector<FacetPictures> pictures(rows.size());
  context.progress->Begin("facade pictures", rows.size());
  const int threads = PictureThreads(rows, context.threads, context.memory_limit_bytes);
  ParallelFor(rows.size(), threads, [&](size_t i) {
    context.ThrowIfCancelled();
    pictures[i] = MakeFacetPictures(rows[i], context.survey / "texture", side_px);
    context.progress->Advance();
  });
  return pictures;
}

}  // namespace

void RunReport(const ReportOptions& options, StageContext& context) {
  SurveyData data = LoadSurvey(context.survey, context.statuses);
  data.plan = PlanOfSurvey(context);
  const std::vector<FacetRow> rows = MakeFacetRows(data, options);
  const std::vector<FacetRow> shown = RowsForPage(rows);
  const std::vector<FacetPictures> pictures = MakePictures(shown, options, context);
  for (const FacetPictures& picture : pictures) {
    if (!picture.problem.empty()) context.progress->Warn(picture.problem);
  }
  WriteFile(context.out / "report.json", ReportJson(data, rows, options));
  WriteFile(context.out / "facades.csv", FacadesCsv(data, rows));
  WriteFile(context.out / "report.html", ReportHtml(data, shown, pictures, options));
  const VerdictCounts counts = CountVerdicts(rows, /*walls_only=*/true);
  context.progress->Note(fmt::format("{} facades: {} good, {} to check, {} poor, {} not rated",
                                     counts.Total(), counts.green, counts.amber, counts.red,
                                     counts.unknown));
}

}  // namespace stucco
