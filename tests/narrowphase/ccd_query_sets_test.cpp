// SPDX-License-Identifier: Apache-2.0
#include "bench/ccd_query_file.h"
#include "dismantle/narrowphase/ccd_edge_edge.h"
#include "dismantle/narrowphase/ccd_lanes.h"
#include "dismantle/narrowphase/ccd_vertex_face.h"
#include "dismantle/narrowphase/elementary_edge_edge.h"
#include "dismantle/narrowphase/elementary_vertex_face.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"
#include "tests/support/test_data.h"

#include <gtest/gtest.h>

namespace dismantle {
namespace {

CcdResult certified(const VertexFaceMotion& m) {
  return ccd_vertex_face(m);
}
CcdResult certified(const EdgeEdgeMotion& m) {
  return ccd_edge_edge(m);
}
CcdResult elementary(const VertexFaceMotion& m) {
  return elementary_vertex_face(m);
}
CcdResult elementary(const EdgeEdgeMotion& m) {
  return elementary_edge_edge(m);
}

CcdBatchResult in_lanes(const std::vector<VertexFaceMotion>& motions) {
  return ccd_vertex_face_lanes(motions);
}
CcdBatchResult in_lanes(const std::vector<EdgeEdgeMotion>& motions) {
  return ccd_edge_edge_lanes(motions);
}

struct Counts {
  int queries = 0, hits = 0;
  int false_positives = 0, false_negatives = 0;
  int elementary_false_positives = 0, elementary_false_negatives = 0;
  int filtered_hits = 0;  ///< Hits that the non-penetration filter called free.
  int lanes_false_positives = 0, lanes_false_negatives = 0;
};

template <class Motion>
void count(const std::vector<Motion>& motions, const std::vector<CcdTruth>& truth, Counts& c) {
  for (std::size_t i = 0; i < motions.size(); ++i) {
    if (truth[i] == CcdTruth::Unknown) continue;
    const bool hit = truth[i] == CcdTruth::Hit;
    const bool found = certified(motions[i]).status == CcdStatus::Contact;
    const bool found_elementary = elementary(motions[i]).status == CcdStatus::Contact;
    ++c.queries;
    c.hits += hit;
    c.false_positives += found && !hit;
    c.false_negatives += !found && hit;
    c.elementary_false_positives += found_elementary && !hit;
    c.elementary_false_negatives += !found_elementary && hit;
    c.filtered_hits += hit && nonpenetration_filter(motions[i]);
  }
  std::vector<bool> found_in_lanes(motions.size());
  for (const CcdBatchContact& contact : in_lanes(motions).contacts) found_in_lanes[contact.query] = true;
  for (std::size_t i = 0; i < motions.size(); ++i) {
    c.lanes_false_positives += found_in_lanes[i] && truth[i] == CcdTruth::Miss;
    c.lanes_false_negatives += !found_in_lanes[i] && truth[i] == CcdTruth::Hit;
  }
}

/// Public queries with exact truth.
const std::filesystem::path kQuerySets = data_folder() / "ccd-queries";

/// Counts over all queries of one set.
Counts count_folder(const char* name) {
  Counts c;
  for (const auto& entry : std::filesystem::directory_iterator(kQuerySets / name)) {
    if (entry.path().extension() != ".ccdq") continue;
    const auto file = read_ccdq(entry.path());
    EXPECT_TRUE(file.ok()) << (file.ok() ? "" : file.error().message);
    if (!file.ok()) continue;
    count(file->vertex_face, file->truth, c);
    count(file->edge_edge, file->truth, c);
  }
  std::printf(
      "%s: %d queries, %d hits; certified: %d false positives, %d false negatives; elementary: %d, %d; lanes: %d, %d\n",
      name, c.queries, c.hits, c.false_positives, c.false_negatives, c.elementary_false_positives,
      c.elementary_false_negatives, c.lanes_false_positives, c.lanes_false_negatives);
  return c;
}

TEST(CcdQuerySets, CertifiedTestMissesNoneOfTheHandcraftedHitsAndReportsFewMisses) {
  DISMANTLE_NEED(kQuerySets / "handcrafted");
  const Counts c = count_folder("handcrafted");
  ASSERT_GT(c.hits, 0);
  EXPECT_EQ(c.false_negatives, 0);
  EXPECT_LE(c.false_positives, 222) << "Tight-Inclusion 1.0.6 reports 222";
  EXPECT_EQ(c.filtered_hits, 0);
  EXPECT_EQ(c.lanes_false_negatives, 0);
  EXPECT_LE(c.lanes_false_positives, c.false_positives);
  EXPECT_EQ(c.elementary_false_negatives, 0) << "not proven, but true of these";
}

TEST(CcdQuerySets, CertifiedTestMissesNoneOfTheSimulationHits) {
  DISMANTLE_NEED(kQuerySets / "simulation");
  const Counts c = count_folder("simulation");
  ASSERT_GT(c.hits, 0);
  EXPECT_EQ(c.false_negatives, 0);
  EXPECT_LE(c.false_positives, 10);
  EXPECT_EQ(c.filtered_hits, 0);
  EXPECT_EQ(c.lanes_false_negatives, 0);
  EXPECT_LE(c.lanes_false_positives, c.false_positives);
}

}  // namespace
}  // namespace dismantle
