// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";

/// Index of a world axis.
export type Axis = 0 | 1 | 2;

/// All axes, in their order.
export const kAxes: readonly Axis[] = [0, 1, 2];

/// Names of the axes as they are shown.
export const kAxisNames = "XYZ";

/// Unit vectors of the axes.
export const kAxisVectors: readonly Vector3[] = [new Vector3(1, 0, 0), new Vector3(0, 1, 0), new Vector3(0, 0, 1)];
