// The answers of the server of `view` (live_run.h): the newest light, pictures of a view, form factors, and the
// control of shots.
#pragma once

#include "runs/live/factor_rows.h"
#include "runs/live/live_board.h"
#include "runs/live/resting_pictures.h"
#include "runs/live/shot_steps.h"
#include "runs/live/web_server.h"

namespace meninas {

/// Answers any number of requests at once; refers to all of these.
struct LiveAnswers {
  LiveBoard& board;
  ShotSteps& steps;
  RestingPictures& pictures;
  FactorRows& factors;

  WebReply operator()(const WebRequest& request) const;
};

/// The view of a query, numbers in metres, degrees and stops; nothing where the query is none.
std::optional<RestingView> view_of(const std::map<std::string, std::string>& query);

} // namespace meninas
