// SPDX-License-Identifier: Apache-2.0
// bench_ccd_queries FILE.ccdq...: every elementary continuous test over query sets with exact truth (FORMATS,
// `*.ccdq`). Prints a header, then a line a file and a test, then a line "total" a test where there are several files:
//   file test n hits false_positives false_negatives ns_mean ns_median ns_p99     (tab-separated)
// Queries of unknown truth are timed but count for neither false column.
//
// Timing. One query is shorter than reading the clock, so no single call is timed. ns_mean is the wall time of whole
// passes over the file, one query after another as a program would run them, divided by the queries (the fastest of
// kPasses passes after one that warms up: other programs only ever add). For the distribution each query is run
// kRepeats times in a row between two clock readings and the time of an empty measurement is taken off; there the
// branch predictor has seen the query before, so ns_median and ns_p99 lean low against ns_mean.
//
// The tests in lanes take batches; their ns_median and ns_p99 are of the means of kBlock queries each.
//   certified_lanes         ns_mean streams: the file's queries over and over, kStreamBytes in all, from memory as it
//   is
//                           after reading a file; processor time of the fastest of kPasses passes, since a pass is
//                           longer than the time that other programs leave alone
//   certified_lanes_cached  blocks of kBlock queries, which stay in a second-level cache, each the fastest of kRepeats
//   certified_lanes_hits    the same for the hits alone, where every query is left to the test in double
#include "bench/ccd_query_file.h"
#include "dismantle/narrowphase/ccd_edge_edge.h"
#include "dismantle/narrowphase/ccd_lanes.h"
#include "dismantle/narrowphase/ccd_vertex_face.h"
#include "dismantle/narrowphase/elementary_edge_edge.h"
#include "dismantle/narrowphase/elementary_vertex_face.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace dismantle;
using Clock = std::chrono::steady_clock;

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

/// What a test did on some queries.
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

double ns_since(Clock::time_point start) {
  return std::chrono::duration<double, std::nano>(Clock::now() - start).count();
}

/// Keeps the compiler from dropping or merging runs of a query.
template <class T>
void keep(T& value) {
  asm volatile("" : : "g"(&value) : "memory");
}

double ns_of_empty_measurement() {
  double least = 1e9;
  for (int i = 0; i < 1000; ++i) least = std::min(least, ns_since(Clock::now()));
  return least;
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

  double fastest = 0;
  for (int pass = 0; pass <= kPasses; ++pass) {
    const Clock::time_point start = Clock::now();
    std::size_t hits = 0;
    for (const Motion& m : motions) hits += Test::hit(m);
    keep(hits);
    const double ns = ns_since(start);
    if (pass == 1 || (pass > 1 && ns < fastest)) fastest = ns;
  }
  tally.mean_sum = fastest;

  const double empty = ns_of_empty_measurement();
  for (const Motion& m : motions) {
    const Clock::time_point start = Clock::now();
    for (int i = 0; i < kRepeats; ++i) {
      bool hit = Test::hit(m);
      keep(hit);
      keep(m);
    }
    tally.each.push_back(static_cast<float>(std::max(0.0, ns_since(start) - empty) / kRepeats));
  }
  return tally;
}

CcdBatchResult in_lanes(Span<const VertexFaceMotion> motions) {
  return ccd_vertex_face_lanes(motions);
}

CcdBatchResult in_lanes(Span<const EdgeEdgeMotion> motions) {
  return ccd_edge_edge_lanes(motions);
}

double wall_ns() {
  return std::chrono::duration<double, std::nano>(Clock::now().time_since_epoch()).count();
}

/// What this thread has had of a processor.
double processor_ns() {
  timespec t = {};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e9 * static_cast<double>(t.tv_sec) + static_cast<double>(t.tv_nsec);
}

/// The ns of a call of the tests in lanes by the clock `now`; the fastest of `passes` after one that warms up.
template <class Motion>
double ns_in_lanes(Span<const Motion> motions, int passes, double (*now)()) {
  double fastest = 0;
  for (int pass = 0; pass <= passes; ++pass) {
    const double start = now();
    CcdBatchResult result = in_lanes(motions);
    keep(result);
    const double ns = now() - start;
    if (pass == 1 || (pass > 1 && ns < fastest)) fastest = ns;
  }
  return fastest;
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
    const double ns = ns_in_lanes(Span<const Motion>(motions).subspan(i, count), kRepeats, wall_ns);
    tally.mean_sum += ns;
    tally.each.push_back(static_cast<float>(ns / count));
  }
  return tally;
}

/// As `cached` but for the mean.
template <class Motion>
Tally run_streamed_lanes(const std::vector<Motion>& motions, Tally cached) {
  std::vector<Motion> stream;
  while (!motions.empty() && stream.size() * sizeof(Motion) < kStreamBytes)
    stream.insert(stream.end(), motions.begin(), motions.end());
  if (stream.empty()) return cached;
  cached.mean_sum = ns_in_lanes(Span<const Motion>(stream), kPasses, processor_ns) / stream.size() * motions.size();
  return cached;
}

template <class Motion>
Tally run_hits_in_lanes(const std::vector<Motion>& motions, const std::vector<CcdTruth>& truth) {
  std::vector<Motion> hits;
  for (std::size_t i = 0; i < motions.size(); ++i)
    if (truth[i] == CcdTruth::Hit) hits.push_back(motions[i]);
  return run_cached_lanes(hits, std::vector<CcdTruth>(hits.size(), CcdTruth::Hit));
}

void print(const std::string& name, const char* test, Tally tally) {
  const auto quantile = [&tally](double q) {
    if (tally.each.empty()) return 0.0f;
    const auto place = tally.each.begin() + static_cast<std::ptrdiff_t>(q * (tally.each.size() - 1));
    std::nth_element(tally.each.begin(), place, tally.each.end());
    return *place;
  };
  const double mean = tally.queries > 0 ? tally.mean_sum / tally.queries : 0;
  std::printf("%s\t%s\t%zu\t%zu\t%zu\t%zu\t%.1f\t%.1f\t%.1f\n", name.c_str(), test, tally.queries, tally.hits,
              tally.false_positives, tally.false_negatives, mean, quantile(0.5), quantile(0.99));
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
Tallies bench(const std::vector<Motion>& motions, const std::vector<CcdTruth>& truth) {
  const Tally cached = run_cached_lanes(motions, truth);
  return {{run<Certified>(motions, truth), run<Elementary>(motions, truth), run<ElementaryFiltered>(motions, truth),
           run_streamed_lanes(motions, cached), cached, run_hits_in_lanes(motions, truth)}};
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_ccd_queries FILE.ccdq...\n");
    return 2;
  }
  Tallies total;
  std::printf("file\ttest\tn\thits\tfalse_positives\tfalse_negatives\tns_mean\tns_median\tns_p99\n");
  for (int i = 1; i < argc; ++i) {
    const auto file = read_ccdq(argv[i]);
    if (!file) {
      std::fprintf(stderr, "%s\n", file.error().message.c_str());
      return 3;
    }
    const Tallies tallies =
        file->vertex_face.empty() ? bench(file->edge_edge, file->truth) : bench(file->vertex_face, file->truth);
    tallies.print(std::filesystem::path(argv[i]).filename().string());
    total.add(tallies);
  }
  if (argc > 2) total.print("total");
  return 0;
}
