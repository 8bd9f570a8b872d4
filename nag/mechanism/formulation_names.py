"""Names of the formulations of a mechanism."""

FORMULATIONS = {
    "E": "Euler parameters, in the plane a cosine and a sine for each body",
    "H": "half-angles, slides and quaternions of the joints",
    "S": "rods between spherical joints as distances, free bodies in Study coordinates",
}
