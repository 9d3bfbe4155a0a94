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
#include "bench/ccd_query_file.h"
#include "dismantle/narrowphase/ccd_edge_edge.h"
#include "dismantle/narrowphase/ccd_vertex_face.h"
#include "dismantle/narrowphase/elementary_edge_edge.h"
#include "dismantle/narrowphase/elementary_vertex_face.h"
#include "dismantle/narrowphase/nonpenetration_filter.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace dismantle;
using Clock = std::chrono::steady_clock;

constexpr int kPasses = 5;
constexpr int kRepeats = 32;

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

template <class Test>
void bench(const std::string& name, const CcdQueryFile& file, Tally& total) {
  const Tally tally =
      file.vertex_face.empty() ? run<Test>(file.edge_edge, file.truth) : run<Test>(file.vertex_face, file.truth);
  print(name, Test::kName, tally);
  total.add(tally);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: bench_ccd_queries FILE.ccdq...\n");
    return 2;
  }
  Tally certified, elementary, filtered;
  std::printf("file\ttest\tn\thits\tfalse_positives\tfalse_negatives\tns_mean\tns_median\tns_p99\n");
  for (int i = 1; i < argc; ++i) {
    const auto file = read_ccdq(argv[i]);
    if (!file) {
      std::fprintf(stderr, "%s\n", file.error().message.c_str());
      return 3;
    }
    const std::string name = std::filesystem::path(argv[i]).filename().string();
    bench<Certified>(name, *file, certified);
    bench<Elementary>(name, *file, elementary);
    bench<ElementaryFiltered>(name, *file, filtered);
  }
  if (argc > 2) {
    print("total", Certified::kName, certified);
    print("total", Elementary::kName, elementary);
    print("total", ElementaryFiltered::kName, filtered);
  }
  return 0;
}
