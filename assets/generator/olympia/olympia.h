#pragma once
/// The models of the show "Ancient Olympia".
///
/// Frames   of the stadium: the origin is the middle of the start sill, +Y along the track (west), +X right
///          (north), +Z up, the track at z = 0. Of what is held or stands by itself: as stated.

#include "assets/generator/craft/part.h"

namespace stadion::assets {

/// A discus of bronze: a lens of 0.22 m with a rounded rim, about its centre; +Z is the axis of symmetry.
Parts discus();

/// A javelin of 2.65 m, about its centre of gravity 1.05 m behind the tip; +X is the nose. Where the hand
/// holds it a leather thong is wound around the shaft.
Parts javelin();

/// A ball of sewn leather of radius 0.11 m, about its centre.
Parts leatherBall();

/// A support for a discus or a ball: a stone of 0.95 m, standing on the origin.
Parts plinth();
/// Two forked posts 1.1 m apart along X, standing on the origin; a javelin lies in them at z = 1.01.
Parts javelinRack();
/// A whitewashed board of 3.2 m on two posts, as decrees were painted on; its face looks along -Y.
Parts whiteboard();

/// The track with the marks on it, its sills, the water channel and its basins.
Parts track();
/// Sills and kerbs of the channel in plain form, for collisions.
Parts stonework();
/// The flat ground at z = 0 under track and embankments, for collisions: two triangles.
Parts groundPlane();
/// The grass embankments around the track.
Parts embankments();
/// The plain, the hill of Kronos and the ridges around the valley, to 3 km.
Parts countryside();

/// Spectators on one embankment (side 1: north, right; -1: south, left) from `low` to `high` along the track,
/// without the nearest (spectators.h). The farther from the start, the plainer.
Parts crowd(double side, double low, double high);

/// Pines, cypresses and olives around the stadium, and the wood on the hill of Kronos.
Parts trees();
Parts kronosWood();

/// The judges' stand with its chairs, the altar of Demeter, tents on the embankments.
Parts stands();
/// The temple of Zeus and the treasuries below the hill of Kronos.
Parts temples();
/// The vaulted passage through the western embankment.
Parts passage();

}  // namespace stadion::assets
