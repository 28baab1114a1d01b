// SPDX-License-Identifier: BSD-3-Clause
// The 3D view of the gallery, by vtk.js. index.html#NAME opens that of the result NAME.
"use strict";

const element = (id) => document.getElementById(id);
const viewer = element("viewer");
const view = JSON.parse(viewer.dataset.view);
const names = [...document.querySelectorAll("article[data-name]")].map((card) => card.dataset.name);

// Where the camera is, before it is turned, and which way is up.
const sides = {
  x: { position: [0, -1, 0], up: [1, 0, 0] },
  y: { position: [0, 0, 1], up: [0, 1, 0] },
  z: { position: [0, -1, 0], up: [0, 0, 1] },
};

let stage = null; // the parts of vtk.js, made when the first view opens
let shown = ""; // the name of the result that is to be seen
let style = "surface";

/** Loads a script, once the page is open: from a disk, browsers read nothing else. */
function load(path) {
  return new Promise((resolve, reject) => {
    const script = document.createElement("script");
    script.src = path;
    script.onload = resolve;
    script.onerror = () => reject(new Error(path + " cannot be loaded"));
    document.head.append(script);
    script.addEventListener("load", () => script.remove());
  });
}

async function numbers(text, ArrayType) {
  const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new ArrayType(await new Response(stream).arrayBuffer());
}

function makeStage() {
  const window3d = vtk.Rendering.Misc.vtkGenericRenderWindow.newInstance({ background: [1, 1, 1] });
  window3d.setContainer(element("scene"));
  // The outer side of the mesh, and the inner one, which has a colour of its own.
  const [actor, back] = [0, 1].map(() => {
    const side = vtk.Rendering.Core.vtkActor.newInstance();
    side.setMapper(vtk.Rendering.Core.vtkMapper.newInstance());
    side.getProperty().set({ edgeColor: [0.1, 0.15, 0.3], ambient: 0.1, diffuse: 0.8, specular: 0.15,
      specularPower: 20 });
    return side;
  });
  back.getProperty().setColor(0.95, 0.55, 0.3);
  back.getProperty().setFrontfaceCulling(true);
  back.getMapper().setScalarVisibility(false);
  new ResizeObserver(() => window3d.resize()).observe(element("scene"));
  return { window3d, actor, back, points: [] };
}

/** A normal at each vertex: those of its triangles, weighted by area. */
function normalsOf(points, triangles) {
  const normals = new Float32Array(points.length);
  for (let t = 0; t < triangles.length; t += 3) {
    const [a, b, c] = [3 * triangles[t], 3 * triangles[t + 1], 3 * triangles[t + 2]];
    const u = [0, 1, 2].map((i) => points[b + i] - points[a + i]);
    const v = [0, 1, 2].map((i) => points[c + i] - points[a + i]);
    for (const corner of [a, b, c]) {
      normals[corner] += u[1] * v[2] - u[2] * v[1];
      normals[corner + 1] += u[2] * v[0] - u[0] * v[2];
      normals[corner + 2] += u[0] * v[1] - u[1] * v[0];
    }
  }
  for (let i = 0; i < normals.length; i += 3) {
    const length = Math.hypot(normals[i], normals[i + 1], normals[i + 2]) || 1;
    for (let axis = 0; axis < 3; ++axis) {
      normals[i + axis] /= length;
    }
  }
  return normals;
}

function polyDataOf(points, triangles, colors) {
  const cells = new Uint32Array((triangles.length / 3) * 4);
  for (let t = 0; t < triangles.length / 3; ++t) {
    cells[4 * t] = 3;
    cells.set(triangles.subarray(3 * t, 3 * t + 3), 4 * t + 1);
  }
  const array = (name, values) =>
    vtk.Common.Core.vtkDataArray.newInstance({ name, numberOfComponents: 3, values });
  const mesh = vtk.Common.DataModel.vtkPolyData.newInstance();
  mesh.getPoints().setData(points, 3);
  mesh.getPolys().setData(cells);
  mesh.getPointData().setNormals(array("Normals", normalsOf(points, triangles)));
  if (colors) {
    mesh.getPointData().setScalars(array("Colors", colors));
  }
  return mesh;
}

/** Moves the camera, along the direction of view, so that the points just fill the window. */
function fit(camera, points) {
  const backwards = camera.getDirectionOfProjection().map((number) => -number);
  const up = camera.getViewUp();
  const right = [0, 1, 2].map(
    (i) => up[(i + 1) % 3] * backwards[(i + 2) % 3] - up[(i + 2) % 3] * backwards[(i + 1) % 3]);
  const axes = [right, up, backwards];
  const seen = (p, axis) => points[p] * axis[0] + points[p + 1] * axis[1] + points[p + 2] * axis[2];
  const low = [Infinity, Infinity, Infinity];
  const high = low.map((number) => -number);
  for (let p = 0; p < points.length; p += 3) {
    axes.forEach((axis, i) => {
      low[i] = Math.min(low[i], seen(p, axis));
      high[i] = Math.max(high[i], seen(p, axis));
    });
  }
  const middle = low.map((number, i) => (number + high[i]) / 2);
  const { clientWidth: width, clientHeight: height } = element("scene");
  const slope = 0.8 * Math.tan((camera.getViewAngle() * Math.PI) / 360);
  const slopes = [(slope * width) / Math.max(height, 1), slope];
  let distance = Number.MIN_VALUE;
  for (let p = 0; p < points.length; p += 3) {
    const [x, y, z] = axes.map((axis, i) => seen(p, axis) - middle[i]);
    distance = Math.max(distance, z + Math.abs(x) / slopes[0], z + Math.abs(y) / slopes[1]);
  }
  const focus = [0, 1, 2].map((i) => axes.reduce((sum, axis, a) => sum + axis[i] * middle[a], 0));
  camera.setFocalPoint(...focus);
  camera.setPosition(...focus.map((number, i) => number + distance * backwards[i]));
}

function resetCamera() {
  const renderer = stage.window3d.getRenderer();
  const camera = renderer.getActiveCamera();
  camera.setFocalPoint(0, 0, 0);
  camera.setPosition(...sides[view.up].position);
  camera.setViewUp(...sides[view.up].up);
  camera.azimuth(view.azimuth);
  camera.elevation(view.elevation);
  camera.orthogonalizeViewUp();
  fit(camera, stage.points);
  renderer.resetCameraClippingRange();
  stage.window3d.getRenderWindow().render();
}

function setStyle(name) {
  style = name;
  for (const id of ["surface", "edges", "wireframe"]) {
    element(id).classList.toggle("chosen", id === name);
  }
  if (stage) {
    const looks = stage.actor.getProperty();
    const isWireframe = name === "wireframe";
    // A wireframe shows the lines of both sides.
    looks.setBackfaceCulling(!isWireframe);
    stage.back.setVisibility(!isWireframe);
    stage.back.getProperty().setEdgeVisibility(name === "edges");
    looks.setRepresentation(isWireframe ? 1 : 2);
    looks.setLighting(!isWireframe);
    looks.setColor(...(isWireframe ? [0.1, 0.15, 0.3] : [0.75, 0.8, 0.9]));
    looks.setEdgeVisibility(name === "edges");
    stage.window3d.getRenderWindow().render();
  }
}

/** Called by the scripts that hold the meshes. */
async function showMesh(content) {
  if (content.name !== shown) {
    return; // another one was chosen while this one was read
  }
  const points = await numbers(content.points, Float32Array);
  const triangles = await numbers(content.triangles, Uint32Array);
  const colors = content.colors && (await numbers(content.colors, Uint8Array));
  if (content.name !== shown) {
    return;
  }
  const mesh = polyDataOf(points, triangles, colors);
  stage.points = points;
  stage.actor.getMapper().setScalarVisibility(Boolean(colors));
  for (const side of [stage.actor, stage.back]) {
    side.getMapper().setInputData(mesh);
    stage.window3d.getRenderer().removeActor(side);
    stage.window3d.getRenderer().addActor(side);
  }
  setStyle(style);
  resetCamera();
  const [vertexCount, triangleCount] = [points.length / 3, triangles.length / 3];
  element("state").textContent =
    `${vertexCount.toLocaleString("en")} vertices, ${triangleCount.toLocaleString("en")} triangles`;
  viewer.dataset.ready = content.name;
}

async function open(name) {
  shown = name;
  viewer.hidden = false;
  document.body.classList.add("viewing");
  delete viewer.dataset.ready;
  element("caption").textContent = name;
  element("state").textContent = "Loading...";
  try {
    if (!window.vtk) {
      await load("gallery/vtk.js");
    }
    stage = stage || makeStage();
    await load(`gallery/${encodeURIComponent(name)}.js`);
  } catch (error) {
    element("state").textContent = `There is no 3D view: ${error.message}`;
  }
}

function followAddress() {
  const name = decodeURIComponent(location.hash.slice(1));
  if (names.includes(name)) {
    open(name);
  } else {
    shown = "";
    viewer.hidden = true;
    document.body.classList.remove("viewing");
  }
}

function step(count) {
  const place = names.indexOf(shown) + count;
  location.hash = encodeURIComponent(names[(place + names.length) % names.length]);
}

const actions = {
  surface: () => setStyle("surface"),
  edges: () => setStyle("edges"),
  wireframe: () => setStyle("wireframe"),
  reset: resetCamera,
  previous: () => step(-1),
  next: () => step(1),
  close: () => { location.hash = "card-" + encodeURIComponent(shown); },
};
for (const [id, action] of Object.entries(actions)) {
  element(id).addEventListener("click", action);
}
const keys = { s: "surface", e: "edges", w: "wireframe", r: "reset", ArrowLeft: "previous",
  ArrowRight: "next", Escape: "close" };
// Before vtk.js, which has keys of its own.
document.addEventListener("keydown", (event) => {
  if (!viewer.hidden && keys[event.key]) {
    event.stopPropagation();
    actions[keys[event.key]]();
  }
}, true);
window.addEventListener("hashchange", followAddress);
setStyle("surface");
followAddress();
