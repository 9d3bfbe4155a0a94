// SPDX-License-Identifier: Apache-2.0
#include "bench/paper/evaluation_page.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace dismantle {
namespace {

Evaluation small_evaluation() {
  Evaluation e;
  e.steps.columns = {"assembly", "triangles", "method", "BVH refit", "intersection test", "overall"};
  e.steps.rows = {{"vice", "77", "front-based", "8", "9", "17"}, {"vice", "77", "streams (elementary)", "1", "2", "3"}};
  e.min_speed_up = 5.67;
  e.min_speed_up_of_shafts = 2.5;
  e.speed_up_chart = {"bars", "y", {"vice 77"}, {{"streams", {}, {5.67}}}};
  e.core_chart = {"cores", "x", "y", {{"streams", {1, 2}, {3, 2}}}};
  e.size_chart = {"sizes", "x", "y", {{"streams", {10, 100}, {3, 2}}}};
  return e;
}

TEST(EvaluationPage, SaysWhereItWasMeasuredAndWhatCameOut) {
  EvaluationSetting setting = present_setting("bench_paper --cores 3", 3);
  setting.date = "2001-02-03";
  setting.gpu = "";
  const std::string page = evaluation_page(small_evaluation(), setting);
  for (const char* part :
       {"    bench_paper --cores 3\n", "2001-02-03; ", "3 cores", "No GPU was available", "| vice | 77 | 1 | 2 | 3 |\n",
        "| vice | 77 | front-based | 8 | 9 | 17 |\n", "5.7 times", "2.5 times", "at the same pose, bit for bit"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  setting.gpu = "Abacus 9";
  const std::string with_gpu = evaluation_page(small_evaluation(), setting);
  EXPECT_NE(with_gpu.find("GPU: Abacus 9."), std::string::npos);
  EXPECT_EQ(with_gpu.find("No GPU was available"), std::string::npos);
}

TEST(EvaluationPage, WarnsWhereTheMethodsDidNotStopAtTheSamePoses) {
  Evaluation e = small_evaluation();
  e.equal_poses = false;
  const std::string page = evaluation_page(e, present_setting("bench_paper", 1));
  EXPECT_NE(page.find("the times cannot be compared"), std::string::npos);
}

TEST(EvaluationPage, ShowsThePicturesThatComeWithIt) {
  const std::vector<EvaluationFile> files = evaluation_files(small_evaluation(), present_setting("bench_paper", 1));
  const std::string& page = files.back().text;
  EXPECT_EQ(files.back().path, "evaluation.md");
  std::size_t pictures = 0;
  for (const EvaluationFile& file : files) {
    EXPECT_FALSE(file.text.empty()) << file.path;
    if (file.path.rfind("pictures/", 0) != 0) continue;
    ++pictures;
    EXPECT_NE(page.find("](" + file.path + ")"), std::string::npos) << file.path;
  }
  EXPECT_EQ(pictures, 3u);
}

}  // namespace
}  // namespace dismantle
