// SPDX-License-Identifier: Apache-2.0
// Time and correctness of the elementary continuous tests over query sets with exact truth (`*.ccdq`, docs/formats.md).
//   bench_ccd_queries FILE.ccdq...
// One row a file and a test, then one row "total" a test where there are several files; tab-separated:
//   file test n hits false_positives false_negatives ns_mean ns_median ns_p99
// Queries of unknown truth are timed but count for neither false column.
//
// Timing. One query is shorter than reading the clock, so no single call is timed. ns_mean is the wall time of whole
// passes over the file, one query after another as a program would run them, divided by the number of queries (the
// fastest of kPasses passes after one that warms up). For the distribution each query is run kRepeats times in a row
// between two clock readings, and the time of an empty measurement is subtracted; there the branch predictor has seen
// the query before, so ns_median and ns_p99 are lower than ns_mean suggests.
//
// The tests in lanes take batches; their ns_median and ns_p99 are of the means of blocks of kBlock queries.
//   certified_lanes         ns_mean streams from memory: the file's queries are repeated to kStreamBytes. Processor
//                           time, since a pass is longer than a time slice.
//   certified_lanes_cached  blocks of kBlock queries, which stay in a second-level cache; each the fastest of kRepeats
//   certified_lanes_hits    the same for the hits alone, where every query falls back to the test in double precision
#include "bench/ccd_query_file.h"
#include "bench/command_line.h"
#include "bench/timing.h"
#include "dismantle/narrowphase/ccd_edge_edge.h"
#include "dismantle/narrowphase/ccd_lanes.h"
#include "dismantle/narrowphase/ccd_vertex_face.h"
#include "dismantle/narrowphase/elementary_edge_edge.h"
#include "dismantle/narrowphase/elementary_vertex_face.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace dismantle;
using bench::keep;

constexpr int kPasses = 5;
constexpr int kRepeats = 32;
constexpr std::size_t kBlock = 1024;
constexpr std::size_t kStreamBytes = std::size_t{256} << 20;

struct Certified {
  static constexpr const char* kName = "certified";
  static bool hit(const VertexFaceMotion& m) { return ccd_vertex_face(m).status == CcdStatus::Contact; }
  static bool hit(const EdgeEdgeMotion& m) { return ccd_edge_edge(m).status == CcdStatus::Contact; }
};

struct Elementary {
  static constexpr const char* kName = "elementary";
  static bool hit(const VertexFaceMotion& m) { return elementary_vertex_face(m).status == CcdStatus::Contact; }
  static bool hit(const EdgeEdgeMotion& m) { return elementary_edge_edge(m).status == CcdStatus::Contact; }
};

struct ElementaryFiltered {
  static constexpr const char* kName = "elementary_filtered";
  static bool hit(const VertexFaceMotion& m) {
    const BernsteinCubic cubic = coplanarity_cubic(m);
    return !certainly_never_coplanar(cubic) && elementary_vertex_face(m, cubic).status == CcdStatus::Contact;
  }
  static bool hit(const EdgeEdgeMotion& m) {
    const BernsteinCubic cubic = coplanarity_cubic(m);
    return !certainly_never_coplanar(cubic) && elementary_edge_edge(m, cubic).status == CcdStatus::Contact;
  }
};

/// Counts and times of a test over some queries.
struct Tally {
  std::size_t queries = 0, hits = 0, false_positives = 0, false_negatives = 0;
  double mean_sum = 0;      ///< [ns], over all queries
  std::vector<float> each;  ///< [ns], one a query

  void add(const Tally& t) {
    queries += t.queries;
    hits += t.hits;
    false_positives += t.false_positives;
    false_negatives += t.false_negatives;
    mean_sum += t.mean_sum;
    each.insert(each.end(), t.each.begin(), t.each.end());
  }
};

/// The time of a measurement of nothing [ns].
double empty_measurement_ns() {
  double fastest = 1e9;
  for (int i = 0; i < 1000; ++i) fastest = std::min(fastest, bench::Stopwatch().ns());
  return fastest;
}

template <class Test, class Motion>
Tally run(const std::vector<Motion>& motions, const std::vector<CcdTruth>& truth) {
  Tally tally;
  tally.queries = motions.size();
  for (std::size_t i = 0; i < motions.size(); ++i) {
    const bool hit = Test::hit(motions[i]);
    tally.hits += hit;
    tally.false_positives += hit && truth[i] == CcdTruth::Miss;
    tally.false_negatives += !hit && truth[i] == CcdTruth::Hit;
  }

  tally.mean_sum = bench::fastest_ns(kPasses, [&] {
    std::size_t hits = 0;
    for (const Motion& m : motions) hits += Test::hit(m);
    keep(hits);
  });

  const double empty = empty_measurement_ns();
  for (const Motion& m : motions) {
    const bench::Stopwatch watch;
    for (int i = 0; i < kRepeats; ++i) {
      bool hit = Test::hit(m);
      keep(hit);
      keep(m);
    }
    tally.each.push_back(static_cast<float>(std::max(0.0, watch.ns() - empty) / kRepeats));
  }
  return tally;
}

CcdBatchResult in_lanes(Span<const VertexFaceMotion> motions) {
  return ccd_vertex_face_lanes(motions);
}

CcdBatchResult in_lanes(Span<const EdgeEdgeMotion> motions) {
  return ccd_edge_edge_lanes(motions);
}

/// The time of a call of the tests in lanes [ns].
template <class Motion>
double lanes_ns(Span<const Motion> motions, int passes, bench::ClockNs now) {
  return bench::fastest_ns(
      passes,
      [&] {
        CcdBatchResult result = in_lanes(motions);
        keep(result);
      },
      now);
}

template <class Motion>
Tally run_cached_lanes(const std::vector<Motion>& motions, const std::vector<CcdTruth>& truth) {
  Tally tally;
  tally.queries = motions.size();
  for (const CcdBatchContact& contact : in_lanes(Span<const Motion>(motions)).contacts) {
    ++tally.hits;
    tally.false_positives += truth[contact.query] == CcdTruth::Miss;
    tally.false_negatives -= truth[contact.query] == CcdTruth::Hit;
  }
  tally.false_negatives += static_cast<std::size_t>(std::count(truth.begin(), truth.end(), CcdTruth::Hit));
  for (std::size_t i = 0; i < motions.size(); i += kBlock) {
    const std::size_t count = std::min(kBlock, motions.size() - i);
    const double ns = lanes_ns(Span<const Motion>(motions).subspan(i, count), kRepeats, bench::wall_ns);
    tally.mean_sum += ns;
    tally.each.push_back(static_cast<float>(ns / count));
  }
  return tally;
}

/// Streams the queries from memory. @param cached the result of run_cached_lanes, of which all but the mean is kept
template <class Motion>
Tally run_streamed_lanes(const std::vector<Motion>& motions, Tally cached) {
  std::vector<Motion> stream;
  while (!motions.empty() && stream.size() * sizeof(Motion) < kStreamBytes)
    stream.insert(stream.end(), motions.begin(), motions.end());
  if (stream.empty()) return cached;
  cached.mean_sum = lanes_ns(Span<const Motion>(stream), kPasses, bench::thread_ns) / stream.size() * motions.size();
  return cached;
}

template <class Motion>
Tally run_hits_in_lanes(const std::vector<Motion>& motions, const std::vector<CcdTruth>& truth) {
  std::vector<Motion> hits;
  for (std::size_t i = 0; i < motions.size(); ++i)
    if (truth[i] == CcdTruth::Hit) hits.push_back(motions[i]);
  return run_cached_lanes(hits, std::vector<CcdTruth>(hits.size(), CcdTruth::Hit));
}

void print(const std::string& name, const char* test, const Tally& tally) {
  const double mean = tally.queries > 0 ? tally.mean_sum / tally.queries : 0;
  std::printf("%s\t%s\t%zu\t%zu\t%zu\t%zu\t%.1f\t%.1f\t%.1f\n", name.c_str(), test, tally.queries, tally.hits,
              tally.false_positives, tally.false_negatives, mean, bench::quantile(tally.each, 0.5),
              bench::quantile(tally.each, 0.99));
}

/// The tallies of all tests.
struct Tallies {
  static constexpr const char* kNames[] = {Certified::kName,  Elementary::kName,        ElementaryFiltered::kName,
                                           "certified_lanes", "certified_lanes_cached", "certified_lanes_hits"};
  std::vector<Tally> of_test = std::vector<Tally>(std::size(kNames));

  void add(const Tallies& t) {
    for (std::size_t i = 0; i < of_test.size(); ++i) of_test[i].add(t.of_test[i]);
  }
  void print(const std::string& name) const {
    for (std::size_t i = 0; i < of_test.size(); ++i) ::print(name, kNames[i], of_test[i]);
  }
};

template <class Motion>
Tallies measure(const std::vector<Motion>& motions, const std::vector<CcdTruth>& truth) {
  const Tally cached = run_cached_lanes(motions, truth);
  return {{run<Certified>(motions, truth), run<Elementary>(motions, truth), run<ElementaryFiltered>(motions, truth),
           run_streamed_lanes(motions, cached), cached, run_hits_in_lanes(motions, truth)}};
}

}  // namespace

int main(int argc, char** argv) {
  bench::CommandLine line("bench_ccd_queries FILE.ccdq...");
  std::vector<std::string> names;
  line.words(names);
  if (!line.parse(argc, argv) || (names.empty() && !line.wrong())) return bench::kExitUsage;
  Tallies total;
  std::printf("file\ttest\tn\thits\tfalse_positives\tfalse_negatives\tns_mean\tns_median\tns_p99\n");
  for (const std::string& name : names) {
    const auto file = read_ccdq(name);
    if (!file) {
      std::fprintf(stderr, "bench_ccd_queries: %s\n", file.error().message.c_str());
      return bench::kExitUnreadable;
    }
    const Tallies tallies =
        file->vertex_face.empty() ? measure(file->edge_edge, file->truth) : measure(file->vertex_face, file->truth);
    tallies.print(std::filesystem::path(name).filename().string());
    total.add(tallies);
  }
  if (names.size() > 1) total.print("total");
  return 0;
}
