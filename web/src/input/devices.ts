// SPDX-License-Identifier: Apache-2.0
import { Vector3 } from "three";
import { axisFields, type HidAxes, type HidCollection, type HidField, readAxes } from "./hid_axes.ts";
import type { RateControl } from "./rate_control.ts";

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

/// HID usage of multi-axis controllers (3D mice) on the generic desktop page.
const kMultiAxis = { usagePage: 1, usage: 8 };
const kRest: HidAxes = [0, 0, 0, 0, 0, 0];
/// Released sticks rest within this distance of their centre.
const kPadDeadZone = 0.08;

/// True if this browser supports WebHID.
export function hasHid(): boolean {
  return "hid" in navigator;
}

/// 3D mice (WebHID) and gamepads, which drive the rate control.
export class Devices {
  private polling = false;
  private padDeflected = false;

  constructor(
    private readonly control: RateControl,
    private readonly onNote: (message: string) => void,
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

  /// Lets the user choose a 3D mouse. Browsers allow this only in response to a click.
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
      // Device axes: right, towards the user, down.
      const [x, y, z, rx, ry, rz] = axes;
      this.control.deflect({ linear: new Vector3(x, -z, y), angular: new Vector3(rx, -rz, ry) });
    });
  }

  /// Polls the gamepad once a frame while one is connected. Left stick: right and up; triggers: away and near; right
  /// stick: rotate; shoulder buttons: roll; second button: cancel the motion.
  private pollGamepads(): void {
    const pad = navigator.getGamepads().find((candidate) => candidate?.mapping === "standard");
    this.polling = pad !== undefined;
    if (!pad) return;
    const pressed = (i: number) => pad.buttons[i]?.value ?? 0;
    if (pressed(1) > 0.5 && this.control.active) void this.control.cancel();
    const linear = new Vector3(pad.axes[0], -pad.axes[1], pressed(6) - pressed(7));
    const angular = new Vector3(pad.axes[3], pad.axes[2], pressed(4) - pressed(5));
    // An idle gamepad must not stop another device.
    const deflected = Math.max(linear.length(), angular.length()) > kPadDeadZone;
    if (deflected || this.padDeflected) this.control.deflect({ linear, angular });
    this.padDeflected = deflected;
    requestAnimationFrame(() => this.pollGamepads());
  }
}

function hid(): Hid {
  return (navigator as unknown as { hid: Hid }).hid;
}
