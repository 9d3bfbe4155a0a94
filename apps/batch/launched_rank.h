// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace dismantle::batch {

/// The rank of this process among those that mpirun (Open MPI) or srun (Slurm) started together.
struct LaunchedRank {
  int rank = 0;        ///< From 0; rank 0 prints the results.
  int local_size = 1;  ///< Number of them on this machine.
};

/// The rank according to the launcher's environment variables; {0, 1} without a launcher.
LaunchedRank launched_rank();

/// Number of workers that this process should start: the cores that it may use, at most its share of the machine. At
/// least 1.
int usable_cores(const LaunchedRank& rank);

}  // namespace dismantle::batch
