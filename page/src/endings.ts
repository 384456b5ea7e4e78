/** What files are by the endings of their names. `tests/program/file_types.rs` compares the lists with the program's. */

/** Files that may be a description; whether one is, its content says. */
const DESCRIBING = ["urdf", "xacro", "xml", "sdf", "mjcf", "world", "usd", "usda", "usdc", "usdz"];
/** Meshes, and what they reference. */
const OF_MESHES = [
  "stl",
  "dae",
  "obj",
  "gltf",
  "glb",
  "ply",
  "msh",
  "mtl",
  "bin",
  "png",
  "jpg",
  "jpeg",
  "tga",
  "bmp",
  "dds",
  "gif",
  "tif",
  "tiff",
  "webp",
  "hdr",
  "exr",
  "ktx2",
  "ppm",
  "pgm",
];
/** What says more of a robot, or of a folder. */
const BESIDE = ["srdf", "yaml", "yml", "toml", "config"];
/** Files that say what their folder is. */
const MANIFESTS = ["package.xml", "model.config"];

function ending(endings: readonly string[]): RegExp {
  return new RegExp(`\\.(?:${endings.join("|")})$`, "i");
}

export const MAY_DESCRIBE = ending(DESCRIBING);
/** A description, and the files that it or a mesh may name. */
export const OF_ROBOT = ending([...DESCRIBING, ...OF_MESHES, ...BESIDE]);
export const IS_XACRO = ending(["xacro"]);
export const IS_ZIP = ending(["zip"]);

const SAYS_WHAT = ending(["urdf", "xacro", ...BESIDE]);

/** Whether a file says what its folder is, or what a robot is: its place is known. */
export function hasPlace(path: string): boolean {
  return SAYS_WHAT.test(path) || MANIFESTS.includes(path.split("/").pop() ?? path);
}
