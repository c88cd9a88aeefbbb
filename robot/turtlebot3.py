"""The TurtleBot3 Waffle Pi in figures, each with its source.

The body's frame is ROS ``base_footprint``: on the floor midway between the driven wheels, x ahead, y left, z up.

Sources:
    [manual]  ROBOTIS e-Manual, TurtleBot3, Features > Specifications (Waffle Pi).
    [urdf]    ROBOTIS, turtlebot3_description, turtlebot3_waffle_pi.urdf; its base_link is 10 mm above base_footprint.
    [gazebo]  ROBOTIS, turtlebot3_description, turtlebot3_waffle_pi.gazebo.xacro.
    [nav2]    ROBOTIS, turtlebot3_navigation2, waffle_pi.yaml: acc_lim_x and acc_lim_theta of the local planner.
    [lds]     ROBOTIS e-Manual, TurtleBot3 appendix, LDS-01 (HLS-LFCD2) data sheet.
    [camera]  Raspberry Pi documentation, Camera Module v2: horizontal field of view.
    [motor]   ROBOTIS e-Manual, DYNAMIXEL XM430-W210.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from .body import CameraModel, Limits

# ------------------------------------------------------------------ the body
MASS_KG = 1.8  # [manual] with computer, battery and sensors
WHEEL_MASS_KG = 0.0285  # [urdf]
WHEEL_RADIUS_M = 0.033  # [urdf], [manual]
WHEEL_WIDTH_M = 0.018  # [urdf]
WHEEL_SEPARATION_M = 0.288  # [urdf] wheels at y = +-0.144; 0.287 in [manual]
WHEEL_TORQUE_MAX_NM = 2.7  # [motor] stall torque at 11.1 V, the robot's battery
CHASSIS_SIZE_M = (0.266, 0.266, 0.094)  # [urdf] collision box
CHASSIS_CENTRE_M = (-0.064, 0.0, 0.057)  # [urdf] 0.047 above base_link
CASTERS_M = ((-0.177, 0.064), (-0.177, -0.064))  # [urdf]
CASTER_RADIUS_M = 0.010  # [urdf] of the box's half height

LIMITS = Limits(
    linear_max_mps=0.26,  # [manual]
    angular_max_radps=1.82,  # [manual]
    linear_acceleration_mps2=2.5,  # [nav2]
    angular_acceleration_radps2=3.2,  # [nav2]
    # The farthest corner of the chassis, behind the axle.
    radius_m=math.hypot(CHASSIS_SIZE_M[0] / 2 - CHASSIS_CENTRE_M[0], CHASSIS_SIZE_M[1] / 2),
)


# ------------------------------------------------------------------ the laser scanner
@dataclass(frozen=True, slots=True)
class LaserModel:
    """A scanner of one plane: evenly spaced beams, counter-clockwise from straight ahead; where it sits on the body."""

    beams: int
    rate_hz: float
    min_range_m: float
    max_range_m: float
    noise_m: float  # one standard deviation
    mount_m: tuple[float, float, float]


LASER = LaserModel(
    beams=360,  # [lds] angular resolution 1 degree
    rate_hz=5.0,  # [lds] 300 rpm
    min_range_m=0.120,  # [lds]
    max_range_m=3.5,  # [lds]
    noise_m=0.01,  # [gazebo]; [lds] states a precision of 10 mm below 0.5 m
    mount_m=(-0.064, 0.0, 0.132),  # [urdf]
)

# ------------------------------------------------------------------ the camera
CAMERA_FOV_RAD = math.radians(62.2)  # [camera] horizontal
CAMERA_MOUNT_M = (0.076, 0.0, 0.103)  # [urdf] camera_rgb_frame
CAMERA_SIZE_PX = (640, 480)  # [gazebo]


def pinhole(centre_px: tuple[float, float]) -> CameraModel:
    """The camera as a pinhole with its principal point at ``centre_px``, which depends on who draws the picture."""
    width_px, height_px = CAMERA_SIZE_PX
    focal_px = width_px / 2 / math.tan(CAMERA_FOV_RAD / 2)
    return CameraModel(width_px, height_px, focal_px, centre_px, CAMERA_MOUNT_M)
