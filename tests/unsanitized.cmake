# What the preset asan runs, read by ctest after the names of the tests. Beginning a program takes as long under sanitizers
# as a short test: tests go in batches, each a process of its own. Those that take long there and run no code that shorter
# ones do not are left out (label `unsanitized`); the others begin with them, so that none runs alone at the end. Each of
# these is a regular expression.
set(unsanitized
  "/contradiction"
  "/faulty_divided"
  "AClosedVolumeWithHigh"
  "AComponentTooLargeFor"
  "AFewPlacesTooFarOff"
  "AFineLatticeAroundTunnels"
  "ALargeSmoothBall"
  "ANumberIsReachedAfterStageOne"
  "ANumberOfVerticesIsReached"
  "ASpacingThatWasIgnored"
  "AVerySmallNumberTakes"
  "AVolumeThatCannotBeLoaded"
  "AgreesWithTheVerificationOnMoved"
  "AnEdgeThatIsLongerThanAskedFor"
  "AnErrorIsKeptWithFewVertices"
  "AnInterruptedRunEndsWithThree"
  "AnIsovalueBesideSamples"
  "AnalyticFields.NamesAreUnique"
  "AngleDefectGrid.OtherTriangles"
  "AreReachedWithoutStageOneAgain"
  "AreWithinTheErrorStated"
  "BallsPassThroughTheirThree"
  "BelowAVoxelIsVerified"
  "BuildInSlabs.GivesTheTriangulation"
  "BuildIsDelaunayByBruteForce"
  "BuildIsDelaunayByIntegers"
  "BuiltinChangesNothing"
  "ClosedSolids.OfASignedDistance"
  "ClosedSolids.OfOnes"
  "ComponentFilter.KeepsTheLargest"
  "ComponentSelection.GiveEachComponent"
  "Creases.AnyNumberOfThreads"
  "CubesWithDividedCellsAreNear"
  "DisplacedHandles.OfNoise"
  "EachTriangleBelongsToOnePass"
  "EdgesInCellFacesAreSampled"
  "EdgesOfWholeVoxelsAre"
  "EndsWhenVerticesOfOtherComponents"
  "EqualExperimentsGiveEqual"
  "ErrorsLargerThanWalls"
  "EveryExperimentOfTheProject"
  "EveryFormatThatIsReadIsTold"
  "EveryOrderOfTheAxesGives"
  "EveryShortRun"
  "ExperimentSchema.AgreesWith"
  "ExplainCommand.WritesThePage"
  "FacetsByHitsThatBoundNothing"
  "FarCrossings.AreThoseThat"
  "FewIntegersAtOneOfThem"
  "FewVerticesStayRight"
  "FindsTheSamePiecesAlongEveryAxis"
  "FinerCubes.KeepAll"
  "FlatBoxesGetGoodAngles"
  "FlatCells.AreLookedAt"
  "FlatCells.OfASmooth"
  "FlippedEdgesKeep"
  "GenerateSuggestsNoIsovalue"
  "GetAPointOffThem"
  "GivesUpMasksEarly"
  "GoingOnIsLikeBeginningAnew"
  "HardFields.Noise"
  "HitsAreThoseOfEverySearch"
  "HoldsOnEngineInTheNoise"
  "ImprovesNoiseAndMasks"
  "InSeveralPasses"
  "InsphereHasTheExactSign"
  "IsKeptWithoutFinerCubes"
  "IsTheSameForAnyNumberOfThreads"
  "IsVerifiedByWhatItsFileSays"
  "IteratedSearch"
  "KeepsNoiseProvenAndNear"
  "KeptBound"
  "LabelsComeInOneFile"
  "LeavesAloneWhatItHasLeft"
  "LeavesOutSmallOnes"
  "LeavesTrianglesThatCrossWhenRounded"
  "LessonBrowser"
  "LessonExperiments"
  "ManyRandomPointsAreAllStarted"
  "MarchingCubesEmbedding.HoldsInRandomCells"
  "MendsPieces"
  "MillimetresFollow"
  "MissedPlaces.AreFoundInEvery"
  "NecksAsThinAsRounding"
  "NoPartOfTheSurfaceIsLeftOut"
  "NoiseAndMasksKeepTopologyAndError"
  "NoiseIsProvenWithFewCubes"
  "NoiseTakesHalfOfTheVertices"
  "OfNoiseAreProvenOnBothSides"
  "OfNoiseAreTakenFromFinerCubes"
  "OfNoiseLeaveLittleFar"
  "OfRandomSamplesNeedNoFinerCubes"
  "OtherCompiler"
  "OtherHeadersSayNothing"
  "OtherPrograms"
  "OthersAfterEveryRemoval"
  "PatchBoxes.ASmallCrowd"
  "RebuildsEveryStateOfTheLiveTriangulation/(double_torus|noise|gyroid|shells)"
  "Recover.AnyNumberOfThreads"
  "RegionsKeepTheirPlaceInEveryCommand"
  "RepairRounds.AreTheSame"
  "ResumingAfterACut"
  "SearchingAgainGivesTheMesh"
  "SeveralLabelsInAFile"
  "Shape.ReplacesTrianglesThatAreTooFar"
  "SheetsHalfAVoxel"
  "SmallAnglesAreTold"
  "SpanningTriangles.DoNotStay"
  "StageOneRunsAgain"
  "StageOneRunsAgainWhere"
  "StepsReachAnError"
  "StlHeader.OptionsWithoutRoom"
  "StlHeader.VerifyNeedsNoOptionTwice"
  "StripsAlongTheWalls"
  "Teaching"
  "TellsWhatACheckOfTheWholeTells"
  "ThatStayEndRepairAfterTwoRounds"
  "TheMeshStaysHomeomorphicToWhatItWas"
  "TheWorstTrianglesAreThere"
  "TooLargeForFinerCubes"
  "TopologyIsTheKnownOneAt"
  "TopologyIsTheKnownOneAtSeveralSizes"
  "TraceWithFlips"
  "TrianglesThatCrossAreMendedByMoreSamples"
  "TrianglesThatNothingFaces"
  "TwoPassesOverTheLevels"
  "TwoShardsMerged"
  "VerifyNeedsNoOptionTwice"
  "VerifyTakesItsBoundFromEveryFormat"
  "VertexRemoval.OfManyAtOnce"
  "WhatIsLeftOutIsTold"
  "at_grid_points"
  "at_the_box_[012]"
  "decades_0"
  "decades_1"
  "decades_2"
  "faulty_divided_cubes"
  "fill_value_2"
  "flat_component"
  "flat_cubes_0"
  "long_cells"
  "mixed_magnitudes_3"
  "near_samples_[01]"
  "silent_specks"
  "top_integers")
list(JOIN unsanitized "|" pattern)
set(tests_of_a_batch 16)
foreach(program IN ITEMS delaunay volume raycast surface experiments)
  set(batched)
  foreach(test IN LISTS test_${program}_TESTS)
    if(test MATCHES "${pattern}")
      set_tests_properties("${test}" PROPERTIES LABELS unsanitized COST 10)
    elseif(batches_of_tests)
      set_tests_properties("${test}" PROPERTIES LABELS batched)
      list(APPEND batched "${test}")
    endif()
  endforeach()
  # Tests that stand together take about as long: each batch gets one in so many.
  list(TRANSFORM batched REPLACE "^${program}\\." "")
  list(LENGTH batched count)
  math(EXPR batches "(${count} + ${tests_of_a_batch} - 1) / ${tests_of_a_batch}")
  set(n 0)
  while(n LESS batches)
    set(filter)
    set(at ${n})
    while(at LESS count)
      list(GET batched ${at} test)
      list(APPEND filter "${test}")
      math(EXPR at "${at} + ${batches}")
    endwhile()
    list(JOIN filter ":" filter)
    add_test("batch.${program}.${n}" "${batches_of_tests}/test_${program}" "--gtest_filter=${filter}")
    set_tests_properties("batch.${program}.${n}" PROPERTIES TIMEOUT 1200)
    math(EXPR n "${n} + 1")
  endwhile()
endforeach()
