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

/// The content of the panel.
export interface WristContent {
  /// The component that is held or pointed at, and a message about it.
  lines: [string, string];
  buttons: WristButton[];
}

const kCanvasSize = { width: 512, height: 400 };
/// [m]
const kWidth = 0.2;
const kHeight = (kWidth * kCanvasSize.height) / kCanvasSize.width;
const kColumns = 3;
const kHeaderHeight = 112;
const kGap = 8;
const kCell = { width: (kCanvasSize.width - kGap * (kColumns + 1)) / kColumns, height: 64 };
const kColors = {
  paper: "#1d232b",
  ink: "#f2f5f8",
  muted: "#9aa6b4",
  button: "#313b47",
  on: "#0072b2",
  off: "#262d36",
};

/// A small panel at the wrist: a status, and buttons that the other hand points at.
export class WristPanel {
  readonly object: Mesh<PlaneGeometry, MeshBasicMaterial>;
  private readonly canvas = document.createElement("canvas");
  private readonly texture: CanvasTexture;
  private content: WristContent = { lines: ["", ""], buttons: [] };
  private hovered: string | null = null;
  private drawn = "";

  constructor() {
    Object.assign(this.canvas, kCanvasSize);
    this.texture = new CanvasTexture(this.canvas);
    this.texture.colorSpace = SRGBColorSpace;
    const material = new MeshBasicMaterial({ map: this.texture, side: DoubleSide });
    this.object = new Mesh(new PlaneGeometry(kWidth, kHeight), material);
    // Above the back of the hand, facing the eyes.
    this.object.position.set(0, 0.06, 0.04);
    this.object.rotation.set(-Math.PI / 3, 0, 0);
  }

  show(content: WristContent): void {
    this.content = content;
    this.paint();
  }

  /// Distance along a ray (room frame) to the panel, and the button there; null if the ray misses.
  intersect(ray: Ray): { distance: number; button: WristButton | null } | null {
    const center = new Vector3().setFromMatrixPosition(this.object.matrixWorld);
    const normal = new Vector3(0, 0, 1).transformDirection(this.object.matrixWorld);
    const slope = ray.direction.dot(normal);
    const distance = Math.abs(slope) < 1e-6 ? -1 : center.sub(ray.origin).dot(normal) / slope;
    if (distance <= 0) return null;
    const local = this.object.worldToLocal(ray.at(distance, new Vector3()));
    const x = (local.x / kWidth + 0.5) * kCanvasSize.width;
    const y = (0.5 - local.y / kHeight) * kCanvasSize.height;
    if (x < 0 || y < 0 || x > kCanvasSize.width || y > kCanvasSize.height) return null;
    const found = this.content.buttons.findIndex((_, i) => {
      const [left, top] = cellOrigin(i);
      return x >= left && x <= left + kCell.width && y >= top && y <= top + kCell.height;
    });
    return { distance, button: this.content.buttons[found] ?? null };
  }

  /// Centre of a button in the room; null if there is no such button.
  centerOf(id: string): Vector3 | null {
    const index = this.content.buttons.findIndex((button) => button.id === id);
    if (index < 0) return null;
    const [left, top] = cellOrigin(index);
    const x = ((left + kCell.width / 2) / kCanvasSize.width - 0.5) * kWidth;
    const y = (0.5 - (top + kCell.height / 2) / kCanvasSize.height) * kHeight;
    return this.object.localToWorld(new Vector3(x, y, 0));
  }

  /// Highlights a button.
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
    const signature = JSON.stringify([this.content, this.hovered]);
    if (signature === this.drawn) return;
    this.drawn = signature;
    const context = this.canvas.getContext("2d")!;
    context.fillStyle = kColors.paper;
    context.fillRect(0, 0, kCanvasSize.width, kCanvasSize.height);
    context.textBaseline = "middle";
    const [first, second] = this.content.lines;
    this.drawText(first, kColors.ink, "600 30px", 36);
    this.drawText(second, kColors.muted, "24px", 80);
    this.content.buttons.forEach((button, i) => {
      this.drawButton(context, button, i);
    });
    this.texture.needsUpdate = true;
  }

  private drawText(line: string, color: string, font: string, y: number): void {
    const context = this.canvas.getContext("2d")!;
    context.fillStyle = color;
    context.font = `${font} system-ui, sans-serif`;
    context.textAlign = "left";
    context.fillText(line, 2 * kGap, y, kCanvasSize.width - 4 * kGap);
  }

  private drawButton(context: CanvasRenderingContext2D, button: WristButton, index: number): void {
    const [left, top] = cellOrigin(index);
    context.fillStyle = !button.enabled ? kColors.off : button.pressed ? kColors.on : kColors.button;
    context.beginPath();
    context.roundRect(left, top, kCell.width, kCell.height, 10);
    context.fill();
    if (button.id === this.hovered) {
      context.strokeStyle = kColors.ink;
      context.lineWidth = 3;
      context.stroke();
    }
    context.fillStyle = button.enabled ? kColors.ink : kColors.muted;
    context.font = "24px system-ui, sans-serif";
    context.textAlign = "center";
    context.fillText(button.label, left + kCell.width / 2, top + kCell.height / 2, kCell.width - 12);
  }
}

function cellOrigin(index: number): [number, number] {
  const [column, row] = [index % kColumns, Math.floor(index / kColumns)];
  return [kGap + column * (kCell.width + kGap), kHeaderHeight + row * (kCell.height + kGap)];
}
