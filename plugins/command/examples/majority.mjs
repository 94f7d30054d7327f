// A rectifier for Seamline in JavaScript: a face that has more good boundary with one neighbouring patch behind
// it than without goes over to that patch. It takes teeth off a boundary and leaves straight ones alone.
//
//     seamline segment part.stl --rectifier '{ command = ["node", "majority.mjs"] }'
//
// Needs apache-arrow (npm install apache-arrow). It stays for mesh after mesh, until its input ends.

import { RecordBatchReader, tableFromArrays, tableToIPC, Table } from "apache-arrow";

const ROUNDS = 3;
const NO_FACE = 4294967295;

/** What an edge costs as a boundary: its length times how badly it serves. */
function costOf(edges, edge) {
  return edges.length[edge] * (0.05 + (edges.sharp.get(edge) ? 0 : edges.score[edge] / 90));
}

function rectify(faces, edges) {
  const labels = Uint32Array.from(faces.label);
  const around = Array.from({ length: labels.length }, () => []);
  for (let edge = 0; edge < edges.left.length; edge++) {
    const [left, right] = [edges.left[edge], edges.right[edge]];
    if (right === NO_FACE) continue;
    const cost = costOf(edges, edge);
    around[left].push([right, cost]);
    around[right].push([left, cost]);
  }
  for (let round = 0; round < ROUNDS; round++) {
    const before = Uint32Array.from(labels);
    for (let face = 0; face < labels.length; face++) {
      // The cost of the boundary a face would have to each label it could take.
      const whole = around[face].reduce((sum, [, cost]) => sum + cost, 0);
      const inside = new Map([[before[face], 0]]);
      for (const [other, cost] of around[face]) {
        inside.set(before[other], (inside.get(before[other]) ?? 0) + cost);
      }
      let best = [whole - inside.get(before[face]), before[face]];
      for (const [label, cost] of [...inside].sort((a, b) => a[0] - b[0])) {
        if (whole - cost < best[0] - 1e-12) best = [whole - cost, label];
      }
      labels[face] = best[1];
    }
  }
  return labels;
}

function columns(table) {
  return Object.fromEntries(
    table.schema.fields.map(({ name }) => {
      const column = table.getChild(name);
      return [name, name === "sharp" ? column : column.toArray()];
    }),
  );
}

let tables = {};
for await (const reader of RecordBatchReader.readAll(process.stdin)) {
  await reader.open({ autoDestroy: false });
  const about = reader.schema.metadata;
  const batches = [];
  for await (const batch of reader) batches.push(batch);
  tables[about.get("seamline.table")] = columns(new Table(reader.schema, batches));
  if (Object.keys(tables).length < about.get("seamline.tables").split(",").length) continue;

  const label = rectify(tables.faces, tables.edges);
  console.error(`${label.length} faces`);
  process.stdout.write(tableToIPC(tableFromArrays({ label }), "stream"));
  tables = {};
}
