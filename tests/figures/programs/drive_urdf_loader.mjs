// Driver of three.js' urdf-loader in Node: jsdom has the browser's DOMParser, a server in this process the files.
//
//     cd node && npm install urdf-loader@0.13.1 three@0.187.0 jsdom && node drive_urdf_loader.mjs
//
// NODE_FOLDER names the folder with node_modules; the default is `node` beside this file. `new URDFLoader().loadAsync(url)`
// with its defaults: visuals, no collisions. `packages` maps the names of the folders in PACKAGES. A visual is among the
// facts if it has something to show: a mesh that cannot be read leaves it empty, with an error on the console.
import { createRequire } from 'node:module';
import { createServer } from 'node:http';
import { existsSync, readFileSync, readdirSync, statSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { createInterface } from 'node:readline';
import { fileURLToPath, pathToFileURL } from 'node:url';

const folder = process.env.NODE_FOLDER || join(dirname(fileURLToPath(import.meta.url)), 'node');
const require = createRequire(join(folder, 'package.json'));
const { JSDOM } = require('jsdom');
const window = new JSDOM('<!DOCTYPE html><html><body></body></html>').window;
for (const name of ['DOMParser', 'Document', 'Element', 'document']) globalThis[name] = window[name];
globalThis.window = window;
globalThis.self = globalThis;
globalThis.ProgressEvent ??= class extends Event {};

let said = [];
const text = parts => parts.map(part => part instanceof Error ? `${part.name}: ${part.message}` : String(part)).join(' ');
for (const level of ['log', 'info', 'warn', 'error', 'debug']) {
    console[level] = (...parts) => said.push(`${level}: ${text(parts).split('\n')[0].replaceAll(origin, '')}`);
}
const THREE = await import(pathToFileURL(join(folder, 'node_modules/three/build/three.module.js')));
const { default: URDFLoader } = await import(pathToFileURL(join(folder, 'node_modules/urdf-loader/src/URDFLoader.js')));

var origin = '';
const server = createServer((request, response) => {
    const path = decodeURIComponent(new URL(request.url, 'http://x').pathname);
    if (!existsSync(path) || !statSync(path).isFile()) {
        response.writeHead(404).end();
    } else {
        response.writeHead(200, { 'Content-Type': 'application/octet-stream' }).end(readFileSync(path));
    }
});
await new Promise(done => server.listen(0, '127.0.0.1', done));
origin = `http://127.0.0.1:${server.address().port}`;

const packages = {};
for (const place of (process.env.PACKAGES || '').split(':').filter(Boolean)) {
    for (const name of readdirSync(place)) {
        if (statSync(join(place, name)).isDirectory()) packages[name] = encodeURI(origin + join(place, name));
    }
}

function number(value) {
    if (typeof value !== 'number') return String(value);
    if (Number.isNaN(value)) return 'nan';
    if (!Number.isFinite(value)) return value > 0 ? 'inf' : '-inf';
    return String(Number(value.toPrecision(7)) + 0);
}
const numbers = values => values.map(number).join(' ');

function pose(object) {
    const { x, y, z, w } = object.quaternion;
    const sign = w < 0 ? -1 : 1;
    return numbers([...object.position.toArray(), sign * w, sign * x, sign * y, sign * z]);
}

function shape(part, file) {
    const [shown] = part.children;
    const kind = shown?.geometry?.type;
    if (file === undefined && kind === 'BoxGeometry') return 'box ' + numbers(shown.scale.toArray());
    if (file === undefined && kind === 'SphereGeometry') return 'sphere ' + number(shown.scale.x);
    if (file === undefined && kind === 'CylinderGeometry') return 'cylinder ' + numbers([shown.scale.x, shown.scale.y]);
    return shown ? `mesh ${decodeURI(file ?? '?').replace(origin, '')} ` + numbers(part.scale.toArray()) : undefined;
}

function inertia(values, rpy) {
    const turn = new THREE.Matrix3().setFromMatrix4(
        new THREE.Matrix4().makeRotationFromEuler(new THREE.Euler(rpy[0], rpy[1], rpy[2], 'ZYX')));
    const { ixx, ixy, ixz, iyy, iyz, izz } = values;
    const tensor = new THREE.Matrix3(ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz);
    const e = turn.clone().multiply(tensor).multiply(turn.clone().transpose()).elements;
    return numbers([e[0], e[3], e[6], e[4], e[7], e[8]]);
}

function ofLink(link, facts, files) {
    const key = `link/${link.urdfName}`;
    facts[key] = 1;
    facts[`${key}/inertial`] = 1;
    facts[`${key}/inertial/mass`] = number(link.inertial.mass);
    facts[`${key}/inertial/com`] = numbers(link.inertial.origin.xyz);
    facts[`${key}/inertial/inertia`] = inertia(link.inertial.inertia, link.inertial.origin.rpy);
    const visuals = link.children.filter(child => child.isURDFVisual && child.children.length);
    facts[`${key}/visual`] = visuals.length;
    visuals.forEach((visual, i) => {
        facts[`${key}/visual/${i}/geometry`] = shape(visual, files.get(visual));
        facts[`${key}/visual/${i}/origin`] = pose(visual);
        if (visual.urdfName) facts[`${key}/visual/${i}/name`] = visual.urdfName;
        const material = visual.children[0].material;
        if (material && !Array.isArray(material) && material.color) {
            facts[`${key}/visual/${i}/color`] = numbers([...material.color.toArray(), material.opacity]);
            if (material.map) facts[`${key}/visual/${i}/texture`] = textures.get(material.map) ?? '?';
        }
    });
}

const textures = new Map();
const loadTexture = THREE.TextureLoader.prototype.load;
THREE.TextureLoader.prototype.load = function (path, ...rest) {
    const texture = loadTexture.call(this, path, ...rest);
    textures.set(texture, decodeURI(path).replace(origin, ''));
    return texture;
};

function ofJoint(joint, facts) {
    const key = `joint/${joint.urdfName}`;
    facts[key] = joint.jointType;
    facts[`${key}/parent`] = joint.parent?.urdfName;
    facts[`${key}/child`] = joint.children.find(child => child.isURDFLink)?.urdfName;
    facts[`${key}/origin`] = pose(joint);
    if (joint.jointType !== 'fixed') facts[`${key}/axis`] = numbers(joint.axis.toArray());
    for (const name of ['lower', 'upper', 'velocity', 'effort']) facts[`${key}/${name}`] = number(joint.limit[name]);
    if (joint.isURDFMimicJoint) facts[`${key}/mimic`] = `${joint.mimicJoint} ${numbers([joint.multiplier, joint.offset])}`;
}

async function answer(path) {
    said = [];
    textures.clear();
    const files = new Map();
    const waits = [];
    try {
        const loader = new URDFLoader(new THREE.LoadingManager());
        loader.packages = packages;
        const ordinary = loader.loadMeshCb;
        let last;
        loader.loadMeshCb = (file, manager, material, done) => {
            const of = { file };
            last = of;
            waits.push(of);
            if (/\.(stl|dae)$/i.test(file)) {
                of.ended = new Promise(resolve => ordinary(file, manager, material, (made, error) => {
                    done(made, error);
                    if (made) files.set(made.parent, file);
                    resolve();
                }));
            } else {
                ordinary(file, manager, material, done);
            }
        };
        const robot = await loader.loadAsync(origin + encodeURI(path));
        const late = new Promise(resolve => setTimeout(resolve, 5000));
        await Promise.race([Promise.all(waits.map(of => of.ended)), late]);
        const facts = { robot: robot.robotName };
        for (const link of Object.values(robot.links)) ofLink(link, facts, files);
        for (const joint of Object.values(robot.joints)) ofJoint(joint, facts);
        return { verdict: 'loads', why: '', said, facts };
    } catch (error) {
        return { verdict: 'refuses', why: text([error]).split('\n')[0], said, facts: {} };
    }
}

for await (const line of createInterface({ input: process.stdin })) {
    process.stdout.write(JSON.stringify(await answer(line)) + '\n');
}
server.close();
process.exit(0);
