/* SPDX-License-Identifier: Apache-2.0 */
/* Follows the pose of a platform on six legs by their lengths, from a control loop. Valid C99 and C++.
 *
 *     regulus_pose pose = start;
 *     for (;;) {   // every millisecond, say
 *       if (regulus_track(&robot, &pose, lengths, errors, &track) != REGULUS_TRACK_ONE_POSE) brake();
 *       pose = track.pose;
 *     }
 *
 * It does not allocate, throw or lock, keeps nothing between calls, and makes at most
 * REGULUS_TRACK_MOST_TESTS evaluations of the six legs. */
#ifndef REGULUS_EMBEDDED_TRACKER_H
#define REGULUS_EMBEDDED_TRACKER_H

#ifdef __cplusplus
extern "C" {
#endif

#define REGULUS_TRACK_MOST_TESTS 64

typedef struct regulus_platform {
  double base[6][3];     /* anchors of the legs, in the frame of the base */
  double platform[6][3]; /* in the frame of the platform */
  double base_error[6];  /* each anchor is no farther from there than this */
  double platform_error[6];
} regulus_platform;

/* The platform's point p is at position + R p, where R is the rotation of the quaternion w x y z, which
 * need not be a unit. */
typedef struct regulus_pose {
  double position[3];
  double rotation[4];
} regulus_pose;

typedef enum regulus_track_verdict {
  REGULUS_TRACK_ONE_POSE = 0, /* proved */
  REGULUS_TRACK_NOT_SHOWN =
      1, /* nothing is claimed: no pose is near, two are, or one that is nearly singular */
  REGULUS_TRACK_BAD_INPUT =
      2 /* a number is not finite, an error or a length is negative, a quaternion is 0 */
} regulus_track_verdict;

typedef struct regulus_track_report {
  regulus_track_verdict verdict;
  regulus_pose
      pose; /* near the new pose; its quaternion is about a unit. The last pose, if none is shown */
  /* The new pose is within this distance and this angle (radians) of `pose`. */
  double distance_error, angle_error;
  /* It is the only one within this distance and this angle of the last pose. */
  double distance_radius, angle_radius;
  unsigned tests; /* evaluations of the six legs */
} regulus_track_report;

/* Shape     lengths, length_errors: by leg.
 * Ensures   REGULUS_TRACK_ONE_POSE: for all lengths within length_errors of `lengths`, and all anchors within
 *           their errors, exactly one pose is within distance_radius and angle_radius of `last`, it is within
 *           distance_error and angle_error of `pose`, and it is not singular. A distance is that of the
 *           platform's origins, an angle that of one rotation to the other, both as exact numbers.
 *           `report` may be null. The caller's floating-point environment is kept, whatever it is. */
regulus_track_verdict regulus_track(const regulus_platform* robot, const regulus_pose* last,
                                    const double* lengths, const double* length_errors,
                                    regulus_track_report* report);

#ifdef __cplusplus
}
#endif

#endif
