// SPDX-License-Identifier: Apache-2.0
import {
  CanvasTexture,
  DoubleSide,
  Mesh,
  MeshBasicMaterial,
  PlaneGeometry,
  type Ray,
  SRGBColorSpace,
  Vector3,
} from "three";

/// A button of the panel.
export interface WristButton {
  id: string;
  label: string;
  enabled: boolean;
  pressed?: boolean;
  press: () => void;
}

/// What the panel shows.
export interface WristContent {
  /// What is held or pointed at, and what is to be said of it.
  lines: [string, string];
  buttons: WristButton[];
}

const kPixels = { width: 512, height: 400 };
/// [m]
const kWidth = 0.2;
const kHeight = (kWidth * kPixels.height) / kPixels.width;
const kColumns = 3;
const kHead = 112;
const kGap = 8;
const kCell = { width: (kPixels.width - kGap * (kColumns + 1)) / kColumns, height: 64 };
const kColors = {
  paper: "#1d232b",
  ink: "#f2f5f8",
  muted: "#9aa6b4",
  button: "#313b47",
  on: "#0072b2",
  off: "#262d36",
};

/// A small board at the wrist: what happens, and buttons that the other hand points at.
export class WristPanel {
  readonly object: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private readonly canvas = document.createElement("canvas");
  private readonly texture: CanvasTexture;
  private content: WristContent = { lines: ["", ""], buttons: [] };
  private hovered: string | null = null;
  private shown = "";

  constructor() {
    Object.assign(this.canvas, kPixels);
    this.texture = new CanvasTexture(this.canvas);
    this.texture.colorSpace = SRGBColorSpace;
    const material = new MeshBasicMaterial({ map: this.texture, side: DoubleSide });
    this.object = new Mesh(new PlaneGeometry(kWidth, kHeight), material);
    // Above the back of the hand, its face to the eyes.
    this.object.position.set(0, 0.06, 0.04);
    this.object.rotation.set(-Math.PI / 3, 0, 0);
  }

  show(content: WristContent): void {
    this.content = content;
    this.paint();
  }

  /// The distance along a ray of the room at which it meets the panel, and the button there; null where it passes by.
  meet(ray: Ray): { distance: number; button: WristButton | null } | null {
    const center = new Vector3().setFromMatrixPosition(this.object.matrixWorld);
    const normal = new Vector3(0, 0, 1).transformDirection(this.object.matrixWorld);
    const slope = ray.direction.dot(normal);
    const distance = Math.abs(slope) < 1e-6 ? -1 : center.sub(ray.origin).dot(normal) / slope;
    if (distance <= 0) return null;
    const place = this.object.worldToLocal(ray.at(distance, new Vector3()));
    const x = (place.x / kWidth + 0.5) * kPixels.width;
    const y = (0.5 - place.y / kHeight) * kPixels.height;
    if (x < 0 || y < 0 || x > kPixels.width || y > kPixels.height) return null;
    const found = this.content.buttons.findIndex((_, i) => {
      const [left, top] = placeOf(i);
      return x >= left && x <= left + kCell.width && y >= top && y <= top + kCell.height;
    });
    return { distance, button: this.content.buttons[found] ?? null };
  }

  /// The middle of a button in the room; null where there is none of that name.
  centerOf(id: string): Vector3 | null {
    const index = this.content.buttons.findIndex((button) => button.id === id);
    if (index < 0) return null;
    const [left, top] = placeOf(index);
    const x = ((left + kCell.width / 2) / kPixels.width - 0.5) * kWidth;
    const y = (0.5 - (top + kCell.height / 2) / kPixels.height) * kHeight;
    return this.object.localToWorld(new Vector3(x, y, 0));
  }

  hover(button: WristButton | null): void {
    this.hovered = button?.enabled ? button.id : null;
    this.paint();
  }

  dispose(): void {
    this.texture.dispose();
    this.object.geometry.dispose();
    this.object.material.dispose();
  }

  private paint(): void {
    const now = JSON.stringify([this.content, this.hovered]);
    if (now === this.shown) return;
    this.shown = now;
    const brush = this.canvas.getContext("2d")!;
    brush.fillStyle = kColors.paper;
    brush.fillRect(0, 0, kPixels.width, kPixels.height);
    brush.textBaseline = "middle";
    const [first, second] = this.content.lines;
    this.write(first, kColors.ink, "600 30px", 36);
    this.write(second, kColors.muted, "24px", 80);
    this.content.buttons.forEach((button, i) => {
      this.paintButton(brush, button, i);
    });
    this.texture.needsUpdate = true;
  }

  private write(words: string, color: string, font: string, y: number): void {
    const brush = this.canvas.getContext("2d")!;
    brush.fillStyle = color;
    brush.font = `${font} system-ui, sans-serif`;
    brush.textAlign = "left";
    brush.fillText(words, 2 * kGap, y, kPixels.width - 4 * kGap);
  }

  private paintButton(brush: CanvasRenderingContext2D, button: WristButton, index: number): void {
    const [left, top] = placeOf(index);
    brush.fillStyle = !button.enabled ? kColors.off : button.pressed ? kColors.on : kColors.button;
    brush.beginPath();
    brush.roundRect(left, top, kCell.width, kCell.height, 10);
    brush.fill();
    if (button.id === this.hovered) {
      brush.strokeStyle = kColors.ink;
      brush.lineWidth = 3;
      brush.stroke();
    }
    brush.fillStyle = button.enabled ? kColors.ink : kColors.muted;
    brush.font = "24px system-ui, sans-serif";
    brush.textAlign = "center";
    brush.fillText(button.label, left + kCell.width / 2, top + kCell.height / 2, kCell.width - 12);
  }
}

function placeOf(index: number): [number, number] {
  const [column, row] = [index % kColumns, Math.floor(index / kColumns)];
  return [kGap + column * (kCell.width + kGap), kHead + row * (kCell.height + kGap)];
}
