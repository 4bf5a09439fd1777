#pragma once
/// The layout of the stadium of Olympia: the outline of the track and the height of the ground.
///
/// Frames   of the stadium, see olympia.h. Metres.

#include "assets/generator/craft/part.h"

namespace stadion::assets {

constexpr double kTrackLength = 192.27;              ///< from sill to sill: 600 Olympic feet of 0.32045 m
constexpr double kTrackSide = 15;                    ///< half the width
constexpr double kTrackLow = -11, kTrackHigh = 204;  ///< along Y
constexpr double kCorner = 2;                        ///< radius of the track's corners
constexpr double kCrest = 29;                        ///< outside the track: middle of the embankments' top
constexpr double kBankEnd = 54;                      ///< outside the track: where the plain begins

constexpr Point kStand{-kTrackSide - 1.2, 64, 0};  ///< middle of the judges' stand's front
constexpr Point kAltar{kTrackSide + 2.4, 64, 0};
constexpr Point kTunnel{10.2, kTrackHigh + 2.2, 0};  ///< middle of the mouth
constexpr Point kKronos{190, 350, 0};                ///< the hill
constexpr Point kTemple{-70, 345, 0};

/// How far the place lies outside the track; negative inside.
double outside(Point p);

/// Height of the ground outside the track, without what is built on it.
double groundHeight(Point p);

/// A closed line around the track, `d` outside of it, counter-clockwise: `kAround` points that lie on common
/// normals for every d.
constexpr int kAround = 216;
std::vector<Point> around(double d);

/// Bands around the track along an outline, from the track outwards; its r is the distance outside the track.
Part ring(const std::vector<Turning>& outline);

/// Returns the colour of the limestone at a place.
Rgb stoneColour(Point p);

}  // namespace stadion::assets
