// SPDX-License-Identifier: Apache-2.0
#include "apps/batch/launched_rank.h"

#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <initializer_list>

namespace dismantle::batch {

namespace {

/// The value of the first of these variables that is set.
int number_of(std::initializer_list<const char*> variables, int otherwise) {
  for (const char* variable : variables)
    if (const char* text = std::getenv(variable)) return std::atoi(text);
  return otherwise;
}

}  // namespace

LaunchedRank launched_rank() {
  return {number_of({"OMPI_COMM_WORLD_RANK", "PMIX_RANK", "SLURM_PROCID"}, 0),
          std::max(1, number_of({"OMPI_COMM_WORLD_LOCAL_SIZE"}, 1))};
}

int usable_cores(const LaunchedRank& rank) {
  const auto cores = static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN));
  cpu_set_t allowed;
  const int bound = sched_getaffinity(0, sizeof allowed, &allowed) == 0 ? CPU_COUNT(&allowed) : cores;
  return std::max(1, std::min(bound, cores / rank.local_size));
}

}  // namespace dismantle::batch
