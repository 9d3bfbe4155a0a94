// SPDX-License-Identifier: Apache-2.0
// The Khronos validator has no types; these are the ones in use.
declare module "gltf-validator" {
  export function validateBytes(
    bytes: Uint8Array,
  ): Promise<{ issues: { numErrors: number; numWarnings: number; messages: object[] } }>;
}
