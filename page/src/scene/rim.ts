/** Light along the outline, which makes a dark robot visible on a dark background. */

import { Color } from "three";
import type { MeshLambertMaterial } from "three";

const rim = { value: new Color(0) };

export function rimColor(color: string): void {
  rim.value.set(color);
}

/** The same material, with light along the outline. */
export function rimmed(material: MeshLambertMaterial): MeshLambertMaterial {
  material.onBeforeCompile = (shader): void => {
    shader.uniforms["rim"] = rim;
    shader.fragmentShader = `uniform vec3 rim;\n${shader.fragmentShader.replace(
      "#include <opaque_fragment>",
      "outgoingLight += rim * (0.09 + pow(1.0 - abs(dot(normalize(normal), normalize(vViewPosition))), 2.0));\n#include <opaque_fragment>",
    )}`;
  };
  return material;
}
