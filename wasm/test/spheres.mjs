// Checks by spheres in JavaScript, against the distances of the spheres.

import assert from "node:assert/strict";
import { load } from "../npm/index.mjs";

/** What spheres answer is what the distances of their centres say, in the poses of the module. */
export async function compareSpheres(bytes, archive, levels) {
  const urdd = await load(bytes);
  const robot = urdd.robot({ name: "spheres.zip", zip: archive });
  const { places, skipped } = robot.skips("pieces");
  const random = Array.from({ length: 300 }, (_, k) => robot.random(k));
  const apart = (a, b) => Math.hypot(...a.map((x, k) => x - b[k]));
  /** The spheres of a level, for each link, in the root link's frame. */
  const placed = (level, q) =>
    robot.linkPoses(q).map(({ position, quaternion_wxyz: [w, x, y, z] }, link) =>
      level.spheres[link].map(({ offset_xyz: p, radius }) => {
        const [tx, ty, tz] = [2 * (y * p[2] - z * p[1]), 2 * (z * p[0] - x * p[2]), 2 * (x * p[1] - y * p[0])];
        const turned = [p[0] + w * tx + y * tz - z * ty, p[1] + w * ty + z * tx - x * tz, p[2] + w * tz + x * ty - y * tx];
        return { centre: turned.map((value, k) => value + position[k]), radius };
      }),
    );
  const points = Array.from({ length: 50 }, (_, k) => [0.05 * Math.cos(k), 0.05 * Math.sin(k), 0.16 + 0.001 * k]);
  const seen = new Set();
  for (const covers of [true, false]) {
    const level = levels.findLast((one) => one.covers === covers);
    const ignored = new Set(level.ignored_pairs.map(({ link_a_idx: a, link_b_idx: b }) => `${a} ${b}`));
    const shapesOf = (link) => places.flatMap(([of], shape) => (of === link ? [shape] : []));
    const isChecked = (a, b) =>
      !ignored.has(`${a} ${b}`) && shapesOf(a).some((i) => shapesOf(b).some((j) => skipped[i][j] === "0"));
    const pairs = level.spheres.flatMap((_, a) => level.spheres.flatMap((_, b) => (a < b && isChecked(a, b) ? [[a, b]] : [])));
    const least = (found) => found.reduce((one, other) => Math.min(one, other), Infinity);
    const distance = (q, cloud) => {
      const links = placed(level, q);
      const between = ([a, b]) => least(links[a].map((one) => least(links[b].map((other) => apart(one.centre, other.centre) - one.radius - other.radius))));
      const toPoint = (point) => least(links.flat().map(({ centre, radius }) => apart(centre, point) - radius - 0.005));
      return Math.min(least(pairs.map(between)), cloud ? least(points.map(toPoint)) : Infinity);
    };
    const checker = robot.sphereChecker({ covers });
    const cloud = { name: "cloud", points: { points, radius: 0.005 } };
    const among = checker.around([{ ...cloud, position: [100, 0, 0] }]);
    // It moves back.
    const around = checker.around([cloud]);
    assert.equal(checker.numDofs, random[0].length);
    for (const [asked, has] of [[checker, false], [among, false], [around, true]]) {
      const touching = covers ? "maybe" : "contact";
      for (const margin of [0, 0.01]) {
        const said = asked.isWithinBatch(Float64Array.from(random.flat()), margin);
        assert.equal(said.length, random.length);
        random.forEach((q, k) => {
          assert.equal(asked.isWithin(q, margin), said[k]);
          const found = distance(q, has);
          if (Math.abs(found - margin) > 1e-4) assert.equal(said[k], found <= margin ? touching : "free", `${k}: ${found}`);
        });
        seen.add(`${touching} ${new Set(said).size}`);
        if (margin === 0) assert.deepEqual(random.map((q) => asked.inCollision(q)), said);
      }
    }
    const [starts, ends] = [random.slice(1), random.slice(0, -1)];
    const options = { resolution: 0.005, open_loops: true };
    const [from, to] = [starts, ends].map((rows) => rows.flat());
    const blocked = around.blockedEdgeBatch(from, to, options);
    const contacts = around.firstContactBatch(from, to, options);
    starts.forEach((start, k) => {
      const at = (part) => distance(start.map((value, dof) => value + part * (ends[k][dof] - value)), true);
      const one = around.firstContact(start, ends[k], options);
      assert.equal(around.blockedEdge(start, ends[k], options) ?? NaN, blocked[k]);
      assert.deepEqual([one?.free ?? NaN, one?.blocked ?? NaN], [...contacts.slice(2 * k, 2 * k + 2)]);
      if (one === null) return assert.ok(at(0) > -1e-4 && at(1) > -1e-4 && Number.isNaN(blocked[k]));
      assert.ok(at(blocked[k]) < 1e-4 && at(one.blocked) < 1e-4 && one.blocked <= blocked[k]);
      assert.ok(one.blocked === 0 || at(one.free) > -1e-4);
    });
    assert.throws(() => checker.around([{ name: "cloud", points: { points, radius: -1 } }]), /obstacle `cloud`/);
    assert.throws(() => checker.around([{ name: "cloud", points: { points: [], radius: 1 } }]), /obstacle `cloud`/);
    const field = { heights: [0, 1, 2], columns: 2, cell: [1, 1], thickness: 1 };
    assert.throws(() => checker.around([{ name: "field", height_field: field }]), /obstacle `field`/);
    assert.throws(() => checker.around([{ ...cloud, ignoring: ["nobody"] }]), /nobody/);
    assert.throws(() => checker.inCollision([...random[0], 0]), /do not divide/);
    if (checker.numDofs > 1) assert.throws(() => checker.inCollisionBatch([...random[0], 0]), /do not divide/);
    assert.throws(() => checker.inCollision(random[0].map(() => NaN)), /value 0/);
    assert.throws(() => checker.isWithin(random[0], -1), /margin/);
    assert.throws(() => checker.blockedEdge(random[0], random[1], { resolution: 0 }), /resolution/);
    assert.throws(() => checker.blockedEdgeBatch(from, random[1]), /values of starts/);
    for (const one of [checker, among, around]) one.close();
    assert.throws(() => checker.inCollision(random[0]), /closed/);
  }
  // Both answers are there.
  assert.ok(seen.has("maybe 2") && seen.has("contact 2"), [...seen].join(", "));
  robot.close();
}
