// The URDF's own shapes: textures of its visual meshes, and its collision geometry.

import assert from "node:assert/strict";
import { mkdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { inPage, run, setting, view } from "./world.mjs";

/** Two by two pixels: red, green, blue, white. */
const PIXELS =
  "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAIAAAD91JpzAAAAFklEQVR4nGP8z8Dwn4GBgYGJgYGBgQEAHRsDAvZcsRAAAAAASUVORK5CYII=";

const set = setting([], (made) => {
  const source = join(made.folder, "painted");
  mkdirSync(join(source, "meshes"), { recursive: true });
  writeFileSync(join(source, "meshes/wood.png"), Buffer.from(PIXELS, "base64"));
  writeFileSync(join(source, "meshes/board.mtl"), "newmtl wood\nKd 1 1 1\nmap_Kd wood.png\n");
  writeFileSync(
    join(source, "meshes/board.obj"),
    `mtllib board.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl wood
f 1/1 2/2 5/3\nf 2/1 3/2 5/3\nf 3/1 4/2 5/3\nf 4/1 1/2 5/3\nf 4/4 3/3 2/2 1/1\n`,
  );
  writeFileSync(
    join(source, "painted.urdf"),
    `<robot name="painted"><link name="a"><visual><origin xyz="0 0 2"/><geometry><mesh filename="meshes/board.obj"/></geometry></visual>
     <collision><origin xyz="0 0 5"/><geometry><cylinder radius="0.5" length="4"/></geometry></collision></link></robot>`,
  );
  const done = run("generate", join(source, "painted.urdf"), "-o", join(made.robots, "painted"));
  assert.equal(done.status, 0, done.stderr);
  return view(made.robots);
});

inPage(set, "a texture is on its mesh, and the collision geometry where the URDF has it", async (page) => {
  await page.waitForFunction(() => globalThis.urdd?.stage.settledOn);
  const seen = () =>
    page.evaluate(() => {
      const { scene } = globalThis.urdd.stage;
      const box = scene.bounds();
      const maps = scene.meshes().map((mesh) => mesh.material.map?.image?.width ?? null);
      return { maps, z: [box.min.z, box.max.z] };
    });
  const original = await seen();
  assert.deepEqual(original.maps, [2]);
  assert.deepEqual(original.z, [2, 3]);
  await page.getByRole("button", { name: "Collision", exact: true }).click();
  await page.waitForFunction(() => globalThis.urdd.stage.scene.has("collision"));
  await page.waitForFunction(() => globalThis.urdd.app.store.now.faults.has("collision"));
  const { z } = await page.evaluate(() => {
    const meshes = globalThis.urdd.stage.scene.meshes();
    let [low, high] = [Infinity, -Infinity];
    for (const mesh of meshes) {
      mesh.geometry.computeBoundingBox();
      const { min, max } = mesh.geometry.boundingBox.clone().applyMatrix4(mesh.matrixWorld);
      [low, high] = [Math.min(low, min.z), Math.max(high, max.z)];
    }
    return { z: [low, high] };
  });
  // A cylinder of 4 m about z = 5 m.
  assert.ok(Math.abs(z[0] - 3) < 1e-6 && Math.abs(z[1] - 7) < 1e-6, String(z));
});
