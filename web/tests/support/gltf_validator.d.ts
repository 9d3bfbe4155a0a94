// SPDX-License-Identifier: Apache-2.0
// Khronos' validator comes without types; what the tests use of it.
declare module "gltf-validator" {
  export function validateBytes(
    bytes: Uint8Array,
  ): Promise<{ issues: { numErrors: number; numWarnings: number; messages: object[] } }>;
}
