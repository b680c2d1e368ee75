"""The meshes of cornell-window.ron, in millimetres: the Cornell box, longer and closed, with a window."""

from mesh import Mesh
from solids import chamfered_box, panel

WIDTH, HEIGHT, NEAR, FAR = 552.8, 548.8, -850.0, 559.2
# The window in the wall at x = WIDTH, and how thick that wall is.
SILL, LINTEL, LEFT, RIGHT, DEPTH = 280.0, 510.0, 90.0, 420.0, 45.0
X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def room():
    white, green, red = Mesh(), Mesh(), Mesh()
    length = FAR - NEAR
    panel(white, (0, 0, NEAR), Z, X, [0, length], [0, WIDTH])
    panel(white, (0, HEIGHT, NEAR), X, Z, [0, WIDTH], [0, length])
    panel(white, (0, 0, FAR), Y, X, [0, HEIGHT], [0, WIDTH])
    panel(white, (0, 0, NEAR), X, Y, [0, WIDTH], [0, HEIGHT])
    panel(green, (0, 0, NEAR), Y, Z, [0, HEIGHT], [0, length])
    across, up = [0, LEFT - NEAR, RIGHT - NEAR, length], [0, SILL, LINTEL, HEIGHT]
    panel(red, (WIDTH, 0, NEAR), Z, Y, across, up, holes=[(1, 1)])
    # The reveal: the four sides of the hole through the wall.
    wide, high = RIGHT - LEFT, LINTEL - SILL
    panel(white, (WIDTH, SILL, LEFT), Z, X, [0, wide], [0, DEPTH])
    panel(white, (WIDTH, LINTEL, LEFT), X, Z, [0, DEPTH], [0, wide])
    panel(white, (WIDTH, SILL, LEFT), X, Y, [0, DEPTH], [0, high])
    panel(white, (WIDTH, SILL, RIGHT), Y, X, [0, high], [0, DEPTH])
    note = "The Cornell box, drawn out towards the camera and closed; millimetres. "
    white.write("window-room-white", note + "Floor, ceiling, end walls, window reveal.")
    green.write("window-room-green", note + "The wall at x = 0.")
    red.write("window-room-red", note + "The wall at x = 552.8, with a hole for the window.")


def bars():
    """A wooden frame in the hole, with one upright and one level bar. They stick a little into the reveal."""
    mesh = Mesh()
    near, far, into, bevel = WIDTH + 14, WIDTH + 34, 2.0, 1.5
    middle, level = (LEFT + RIGHT) / 2, SILL + 0.6 * (LINTEL - SILL)
    for z in (LEFT, RIGHT):
        low, high = (z - into, z + 14) if z == LEFT else (z - 14, z + into)
        chamfered_box(mesh, (near, SILL - into, low), (far, LINTEL + into, high), bevel)
    for y in (SILL, LINTEL):
        low, high = (y - into, y + 14) if y == SILL else (y - 14, y + into)
        chamfered_box(mesh, (near + 0.7, low, LEFT - into), (far - 0.7, high, RIGHT + into), bevel)
    chamfered_box(mesh, (near + 2, SILL - into, middle - 7), (far - 2, LINTEL + into, middle + 7), bevel)
    chamfered_box(mesh, (near + 2.7, level - 6, LEFT - into), (far - 2.7, level + 6, RIGHT + into), bevel)
    mesh.write("window-bars", "The frame and bars of a window; millimetres.")


if __name__ == "__main__":
    room()
    bars()
