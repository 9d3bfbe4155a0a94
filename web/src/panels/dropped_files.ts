// SPDX-License-Identifier: Apache-2.0

/// A file, and its path below the folder that was chosen or dropped.
export interface PathedFile {
  path: string;
  file: File;
}

/// Files that assemblies refer to, beside those that can be opened.
export const kCompanions = [".mtl", ".bin"];

/// The files of a drop, those in dropped folders included.
export async function droppedFiles(data: DataTransfer): Promise<PathedFile[]> {
  const entries = [...data.items].map((item) => item.webkitGetAsEntry()).filter((entry) => entry !== null);
  if (entries.length === 0) return [...data.files].map((file) => ({ path: file.name, file }));
  return (await Promise.all(entries.map((entry) => filesOf(entry)))).flat();
}

/// The files that a person has chosen; of a folder, with their paths.
export function chosenFiles(list: FileList): PathedFile[] {
  return [...list].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
}

/// The files that may belong to an assembly. @param extensions of the files that can be opened
export function usefulFiles(files: PathedFile[], extensions: string[]): PathedFile[] {
  const known = [...extensions, ...kCompanions];
  return files.filter(({ path }) => known.some((extension) => path.toLowerCase().endsWith(extension)));
}

/// The folder that all files are in; empty if there is none.
export function commonFolder(files: PathedFile[]): string {
  const first = files[0]?.path.split("/") ?? [];
  return first.length > 1 && files.every(({ path }) => path.startsWith(`${first[0]}/`)) ? first[0] : "";
}

/// The body of POST /api/open_files: for each file a line of JSON, then its bytes.
export function packedFiles(files: PathedFile[]): Blob {
  return new Blob(files.flatMap(({ path, file }) => [`${JSON.stringify({ path, bytes: file.size })}\n`, file]));
}

async function filesOf(entry: FileSystemEntry): Promise<PathedFile[]> {
  if (entry.isFile) {
    const file = await new Promise<File>((resolve, reject) => (entry as FileSystemFileEntry).file(resolve, reject));
    return [{ path: entry.fullPath.replace(/^\//, ""), file }];
  }
  const reader = (entry as FileSystemDirectoryEntry).createReader();
  const found: PathedFile[] = [];
  // A reader gives a part of the entries at a time, and none at the end.
  for (;;) {
    const part = await new Promise<FileSystemEntry[]>((resolve, reject) => reader.readEntries(resolve, reject));
    if (part.length === 0) return found;
    for (const child of part) found.push(...(await filesOf(child)));
  }
}
