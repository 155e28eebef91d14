// Which objects are solid things, seen from outside, and which are walls and sheets around or behind what one looks at.
'use strict';

// Whether all vertices lie on one side of each face.
function isConvex(faces) {
    const vertices = faces.flatMap(face => face.vertices);
    const slack = 1e-4 * vec.length(vec.sub(vertices[0], vertices[2]));
    const isOneSided = face => {
        const heights = vertices.map(v => vec.dot(face.normal, vec.sub(v, face.vertices[0])));
        return heights.every(h => h < slack) || heights.every(h => h > -slack);
    };
    return faces.length < 100 && faces.every(isOneSided);
}

// Whether every edge belongs to two faces.
function isClosed(faces) {
    const counts = new Map();
    for (const {vertices, count} of faces)
        vertices.forEach((from, k) => {
            const edge = [from, vertices[(k + 1) % count]].map(String).sort().join(' ');
            counts.set(edge, (counts.get(edge) || 0) + 1);
        });
    return [...counts.values()].every(count => count === 2);
}

// The numbers of the objects that turn some faces to the camera and some away, and are closed, or convex as a block
// without a floor is. isTurned(face): away from the camera.
function findSolids(faces, isTurned) {
    const objects = new Map();
    for (const face of faces) {
        if (!objects.has(face.object)) objects.set(face.object, []);
        objects.get(face.object).push(face);
    }
    const isSolid = own => own.some(isTurned) && !own.every(isTurned) && (isClosed(own) || isConvex(own));
    return new Set([...objects].filter(([, own]) => isSolid(own)).map(([number]) => number));
}
