// Vectors of three numbers, as arrays.
'use strict';

const vec = {
    add: (a, b) => [a[0] + b[0], a[1] + b[1], a[2] + b[2]],
    sub: (a, b) => [a[0] - b[0], a[1] - b[1], a[2] - b[2]],
    scale: (s, a) => [s * a[0], s * a[1], s * a[2]],
    dot: (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2],
    cross: (a, b) => [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]],
    length: a => Math.hypot(...a),
    unit: a => vec.scale(1 / (Math.hypot(...a) || 1), a),
};

// The rows of the matrix that takes the scene to the picture of an onlooker at `eye`, who looks against `back`.
function projection(eye, [right, up, back], halfAngle, shape, near, far) {
    const f = 1 / Math.tan(halfAngle);
    const a = (far + near) / (near - far);
    const b = (2 * far * near) / (near - far);
    const x = f / shape;
    return [
        [...vec.scale(x, right), -x * vec.dot(right, eye)],
        [...vec.scale(f, up), -f * vec.dot(up, eye)],
        [...vec.scale(a, back), -a * vec.dot(back, eye) + b],
        [...vec.scale(-1, back), vec.dot(back, eye)],
    ];
}

const projected = (rows, at) => rows.map(row => row[0] * at[0] + row[1] * at[1] + row[2] * at[2] + row[3]);

// The t at which a ray from `eye` meets the triangle; 0 where it does not. After Moeller and Trumbore (1997).
function triangleHit(eye, direction, a, b, c) {
    const e = vec.sub(b, a);
    const f = vec.sub(c, a);
    const p = vec.cross(direction, f);
    const det = vec.dot(e, p);
    if (Math.abs(det) < 1e-12) return 0;
    const s = vec.sub(eye, a);
    const u = vec.dot(s, p) / det;
    const q = vec.cross(s, e);
    const v = vec.dot(direction, q) / det;
    return u >= 0 && v >= 0 && u + v <= 1 ? Math.max(0, vec.dot(f, q) / det) : 0;
}
