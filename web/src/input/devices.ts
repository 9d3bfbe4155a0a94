// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import { axisFields, type HidAxes, type HidCollection, type HidField, readAxes } from "./hid_axes.ts";
import type { RateHand } from "./rate_hand.ts";

interface HidDevice extends EventTarget {
  opened: boolean;
  productName: string;
  collections: HidCollection[];
  open(): Promise<void>;
}

interface HidReportEvent extends Event {
  reportId: number;
  data: DataView;
}

interface Hid extends EventTarget {
  getDevices(): Promise<HidDevice[]>;
  requestDevice(options: { filters: object[] }): Promise<HidDevice[]>;
}

/// Multi-axis controllers: the generic desktop page's usage of 3D mice.
const kMultiAxis = { usagePage: 1, usage: 8 };
const kRest: HidAxes = [0, 0, 0, 0, 0, 0];
/// Sticks that are let go of stay off their middle by less than this.
const kPadRest = 0.08;

/// Whether this browser can reach 3D mice at all.
export function hasHid(): boolean {
  return "hid" in navigator;
}

/// 3D mice by WebHID, and gamepads, as the rate hand's deflection.
export class Devices {
  private polling = false;
  private padDeflected = false;

  constructor(
    private readonly hand: RateHand,
    private readonly onNote: (sentence: string) => void,
  ) {
    if (hasHid()) {
      void hid()
        .getDevices()
        .then((devices) => Promise.all(devices.map((device) => this.listen(device))));
      hid().addEventListener("connect", (event) => void this.listen((event as Event & { device: HidDevice }).device));
    }
    window.addEventListener("gamepadconnected", () => {
      if (!this.polling) this.pollGamepads();
    });
  }

  /// Lets the user choose a 3D mouse; only by a press of a button.
  async choose(): Promise<void> {
    const chosen = await hid().requestDevice({ filters: [kMultiAxis] });
    for (const device of chosen) await this.listen(device);
  }

  private async listen(device: HidDevice): Promise<void> {
    const fields = axisFields(device.collections);
    if (fields.length === 0 || device.opened) return;
    try {
      await device.open();
    } catch (error) {
      this.onNote((error as Error).message);
      return;
    }
    this.follow(device, fields);
    this.onNote(device.productName);
  }

  private follow(device: HidDevice, fields: HidField[]): void {
    let axes = kRest;
    device.addEventListener("inputreport", (event) => {
      const { reportId, data } = event as HidReportEvent;
      axes = readAxes(fields, reportId, data, axes);
      // The device's axes: right, towards the user, down.
      const [x, y, z, rx, ry, rz] = axes;
      this.hand.deflect({ linear: new Vector3(x, -z, y), angular: new Vector3(rx, -rz, ry) });
    });
  }

  /// Asks the gamepads once a frame while there is one. Left stick: right and up; triggers: away and near; right stick:
  /// turn; shoulder buttons: roll; the second button: back to where the motion began.
  private pollGamepads(): void {
    const pad = navigator.getGamepads().find((candidate) => candidate?.mapping === "standard");
    this.polling = pad !== undefined;
    if (!pad) return;
    const pressed = (i: number) => pad.buttons[i]?.value ?? 0;
    if (pressed(1) > 0.5 && this.hand.holds) void this.hand.cancel();
    const linear = new Vector3(pad.axes[0], -pad.axes[1], pressed(6) - pressed(7));
    const angular = new Vector3(pad.axes[3], pad.axes[2], pressed(4) - pressed(5));
    // A gamepad that lies there must not bring another device to rest.
    const deflected = Math.max(linear.length(), angular.length()) > kPadRest;
    if (deflected || this.padDeflected) this.hand.deflect({ linear, angular });
    this.padDeflected = deflected;
    requestAnimationFrame(() => this.pollGamepads());
  }
}

function hid(): Hid {
  return (navigator as unknown as { hid: Hid }).hid;
}
