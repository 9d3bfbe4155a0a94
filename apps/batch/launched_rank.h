// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dismantle::batch {

/// Where this process stands among those that mpirun (Open MPI) or srun (Slurm) started together.
struct LaunchedRank {
  int rank = 0;        ///< The first one speaks for all.
  int local_size = 1;  ///< How many of them are on this machine.
};

/// As the launcher's environment says; the only one where there is none.
LaunchedRank launched_rank();

/// Number of processes that can work here: the cores that this process may use, shared with the others of `rank`'s
/// machine.
int usable_cores(const LaunchedRank& rank);

}  // namespace dismantle::batch
