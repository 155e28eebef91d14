// Which objects are solid things, seen from outside, and which are walls and sheets around or behind what one looks at.
'use strict';

const heightOver = (face, point) => vec.dot(face.normal, vec.sub(point, face.vertices[0]));

// Whether all vertices lie on one side of each face, and the camera on the other side of one of them.
function isConvexSeenFromOutside(faces, camera) {
    if (faces.length < 2 || faces.length > 100) return false;
    const vertices = faces.flatMap(face => face.vertices);
    const slack = 1e-4 * vec.length(vec.sub(vertices[0], vertices[2]));
    let outside = false;
    for (const face of faces) {
        const heights = vertices.map(v => heightOver(face, v));
        const low = Math.min(...heights);
        const high = Math.max(...heights);
        if (low < -slack && high > slack) return false;
        outside = outside || heightOver(face, camera) * (low + high) < 0;
    }
    return outside;
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

// The numbers of the objects that are convex, as a block without a floor is, or closed, with faces that are turned to
// the camera and others that are turned away: it is outside of them.
function findSolids(faces, camera) {
    const objects = new Map();
    for (const face of faces) {
        if (!objects.has(face.object)) objects.set(face.object, []);
        objects.get(face.object).push(face);
    }
    const isTurned = face => heightOver(face, camera) < 0;
    const isSolid = own =>
        isConvexSeenFromOutside(own, camera) || (own.some(isTurned) && !own.every(isTurned) && isClosed(own));
    return new Set([...objects].filter(([, own]) => isSolid(own)).map(([number]) => number));
}
