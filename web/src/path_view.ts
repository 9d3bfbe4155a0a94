// SPDX-License-Identifier: Apache-2.0
import { Box3, Vector3 } from "three";
import type { GuideStep } from "./guide.ts";
import { matrixOf } from "./pose.ts";
import type { Session } from "./session.ts";
import type { Source } from "./wire/messages.ts";

/// Maximum side of the region that is fitted, in diagonals of the assembly.
const kMaxExtent = 8;

/// Bounds of the assembly and of its components after each step, limited so that the assembly remains large enough:
/// recordings can move components far away.
export function pathExtent(session: Session, steps: GuideStep[]): Box3 {
  const { components } = session.store.model!;
  const boxes = components.map(({ bounds: [low, high] }) => new Box3(new Vector3(...low), new Vector3(...high)));
  const all = boxes.reduce((sum, box) => sum.union(box), new Box3());
  for (const { components: set, frames } of steps)
    for (const c of set) all.union(boxes[c].clone().applyMatrix4(matrixOf(frames[frames.length - 1].pose)));
  const { modelBox } = session;
  const side = kMaxExtent * modelBox.getSize(new Vector3()).length();
  return all.intersect(
    new Box3().setFromCenterAndSize(modelBox.getCenter(new Vector3()), new Vector3(side, side, side)),
  );
}

/// Fits the view to a path that is played, unless all of it is in the picture.
export async function showPath(session: Session, source: Source): Promise<void> {
  try {
    const { rig } = session.viewport;
    const extent = pathExtent(session, await session.loadSteps(source));
    if (!rig.shows(extent)) rig.fit(extent);
  } catch {
    // The playback reports what is wrong with the path.
  }
}
